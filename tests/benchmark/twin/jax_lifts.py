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
from colift.benchmark.training.pool import TWIN
from colift.benchmark.training.sensing import OWN, with_losses
from colift.benchmark.twin.agents import play_agents
from colift.benchmark.twin.drawing import draw_lifts
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin

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
        ({"task": Other()}, "the task level, and tasks that are stated by rules .*'other' is"),
        ({"partner": "live"}, "not 'live'"),
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
    together = rollout(TWIN, copying, None, lifts).rmse_mm
    assert np.asarray(together) == pytest.approx(play_agents(Copy, LIFTS), rel=1e-4)


def test_a_lift_is_the_same_whatever_is_played_beside_it():
    alone = rollout(TWIN, copying, None, draw_lifts(LIFTS[:1])).rmse_mm
    assert float(alone[0]) == pytest.approx(
        float(rollout(TWIN, copying, None, draw_lifts(LIFTS)).rmse_mm[0]), rel=1e-5
    )


def test_the_gradient_is_that_of_differences():
    lifts = draw_lifts(LIFTS)

    @jax.jit
    @jax.value_and_grad
    def error(lead):
        def policy(last, view):
            return view[0], view[0] + lead * (view[0] - last) - view[3]

        return rollout(TWIN, policy, jnp.zeros(2), lifts).rmse_mm.mean()

    (low, _), (_, gradient), (high, _) = map(error, (0.95, 1.0, 1.05))
    assert float(gradient) == pytest.approx(float(high - low) / 0.1, rel=0.02)


def test_a_lost_sample_is_the_last_one_again():
    lifts = draw_lifts(LIFTS[:1])
    lost = with_losses(lifts, jnp.full(1, 0.5), jax.random.key(0))
    ages = np.asarray(lost.ages[:, 0])
    assert ages[0] == lifts.ages[0, 0] == 10
    assert set(ages) == {10, 20, 25}
    for step in np.flatnonzero(ages == 20):
        assert np.array_equal(lost.errors[step, :2], lifts.errors[step - 1, :2])
    held, seen = (float(rollout(TWIN, copying, None, each).rmse_mm[0]) for each in (lost, lifts))
    assert held > 1.2 * seen


def test_a_policy_sees_the_error_of_its_own_command():
    """It brings its command to nought; with an error of a centimetre it is off by less."""
    lifts = draw_lifts(LIFTS[:1])

    def holding(memory, view):
        return memory, -view[3]

    off = lifts._replace(errors=lifts.errors.at[:, OWN].set(jnp.array([[0.0], [-0.01]])))
    low, higher = (rollout(TWIN, holding, None, each).rmse_mm for each in (lifts, off))
    assert 5 < float(low[0] - higher[0]) < 10


def test_samples_may_be_older_than_the_usual_memory():
    """With a latency of 0.3 s, the twin keeps more of the past."""
    late = [(make_scenario("smooth", "S2", latency=0.3), 7)]
    twin, lifts = TaskTwin.of([scenario for scenario, _ in late]), draw_lifts(late)
    assert np.asarray(rollout(twin, copying, None, lifts).rmse_mm) == pytest.approx(
        play_agents(Copy, late), rel=1e-4
    )
