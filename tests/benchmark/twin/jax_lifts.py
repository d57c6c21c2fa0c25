"""Drawn lifts, whole rollouts and their gradient."""

import dataclasses

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from colift.agents.policies.copy import Copy
from colift.base.errors import InputError
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.twin.agents import play_agents
from colift.benchmark.twin.lifts import draw_lifts
from colift.benchmark.twin.rollout import Sensing, rollout

LIFTS = [(make_scenario(behaviour, "S2"), 7) for behaviour in ("smooth", "pause")]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Other(Level):
    name = "other"


class Bringing:
    """A behaviour whose plans are carried out by an agent of its own."""

    def plan(self, subject, seed):
        return LIFTS[0][0].human.plan(subject, seed)

    def person(self, subject):
        return Copy()


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"task": Other()}, "the task level only, not 'other'"),
        ({"partner": "live"}, "not 'live'"),
        ({"latency": 0.3}, "a latency of 0.3 s needs more"),
        ({"human": Bringing(), "behaviour": "bringing"}, "'bringing' brings its own"),
    ],
)
def test_what_is_not_modelled_is_refused_by_name(changes, message):
    scenario = dataclasses.replace(LIFTS[0][0], **changes)
    with pytest.raises(InputError, match=message):
        draw_lifts([(scenario, 1)])


def test_lifts_of_two_periods_are_refused():
    other = make_scenario("smooth", "S2", control_period=0.05)
    with pytest.raises(InputError, match="one control period, got 2"):
        draw_lifts([*LIFTS, (other, 7)])


def copying(memory, view):
    return memory, view[0] - view[3]


def test_a_rollout_has_the_errors_of_the_same_policy_played_step_by_step():
    lifts = draw_lifts(LIFTS)
    together = rollout(copying, None, lifts).rmse_mm
    assert np.asarray(together) == pytest.approx(play_agents(Copy, LIFTS), rel=1e-4)


def test_a_lift_is_the_same_whatever_is_played_beside_it():
    alone = rollout(copying, None, draw_lifts(LIFTS[:1])).rmse_mm
    assert float(alone[0]) == pytest.approx(
        float(rollout(copying, None, draw_lifts(LIFTS)).rmse_mm[0]), rel=1e-5
    )


def test_the_gradient_is_that_of_differences():
    lifts = draw_lifts(LIFTS)

    @jax.jit
    @jax.value_and_grad
    def error(lead):
        def policy(last, view):
            return view[0], view[0] + lead * (view[0] - last) - view[3]

        return rollout(policy, jnp.zeros(2), lifts).rmse_mm.mean()

    (low, _), (_, gradient), (high, _) = map(error, (0.95, 1.0, 1.05))
    assert float(gradient) == pytest.approx(float(high - low) / 0.1, rel=0.02)


def test_a_lost_sample_is_the_last_one_again():
    lifts = draw_lifts(LIFTS[:1])
    steps = lifts.longest()
    all_lost = Sensing(jnp.ones((steps, 1)), jnp.zeros((steps, 2, 1)))
    held = rollout(copying, None, lifts, sensing=all_lost).rmse_mm
    assert float(held[0]) > 3 * float(rollout(copying, None, lifts).rmse_mm[0])


def test_a_policy_sees_the_error_of_its_own_command():
    """It brings its command to nought; with an error of a centimetre it is off by less."""
    lifts = draw_lifts(LIFTS[:1])

    def holding(memory, view):
        return memory, -view[3]

    error = jnp.zeros((lifts.longest(), 2, 1)).at[:, 1].set(-0.01)
    sensing = Sensing(jnp.zeros((lifts.longest(), 1)), error)
    low, higher = (rollout(holding, None, lifts, sensing=each).rmse_mm for each in (None, sensing))
    assert 5 < float(low[0] - higher[0]) < 10
