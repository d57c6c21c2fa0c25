"""The twin of two hurdles: the lifts of the engine, and the beliefs of its people."""

from functools import cache
from itertools import cycle

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from colift.agents.tasks.agree.agree_game import AgreeGame
from colift.agents.tasks.agree.observation import AgreeObservation as Seen
from colift.benchmark.suites.catalogue import make_scenario, make_task
from colift.benchmark.tasks.agree import negotiating
from colift.benchmark.tasks.agree.task import Agree
from colift.benchmark.twin.task_twin import TaskTwin
from colift.benchmark.twin.touch_lifts import draw_touch, stack_touch
from colift.benchmark.world.table import TABLE_LENGTH

from .played import Played, agents_in_twin, engine_scores

TWIN = TaskTwin(make_task("agree"))

PEOPLE = range(210_004, 210_006)
"""Seeds of people and lifts outside all suites."""
LIFTS = [
    (make_scenario(behaviour, f"draw-{seed}", task="agree"), seed)
    for behaviour, seed in zip((*Agree.behaviours, "smooth"), cycle(PEOPLE), strict=False)
]


def leading(gain):
    """Return a policy that keeps level by touch, and goes to its hurdle in the whole window."""

    def policy(memory, seen):
        torque = seen[Seen.TORQUE]
        near = seen[Seen.HAND_HEIGHT] + TABLE_LENGTH * torque * (1 - torque**2 / 6)
        window = (seen[Seen.HURDLE_START] < 0.3) & (seen[Seen.HURDLE_STOP] > 0.0)
        goes = gain * seen[Seen.HURDLE_GIVEN] * window
        to = seen[Seen.HURDLE_HEIGHT] - seen[Seen.HAND_COMMAND]
        kept = 2 * near - memory - seen[Seen.HAND_COMMAND]
        return near, goes * to + (1 - goes) * kept

    return policy


def yielding(memory, seen):
    return memory, -0.06 * seen[Seen.FORCE]


def in_engine(make):
    return np.array([each["rmse_mm"] for each in engine_scores(make, LIFTS)])


@cache
def played(policy):
    """Return the errors in the engine: two tests have the same policy."""
    return in_engine(lambda: Played(policy))


def in_twin(policy, lifts):
    return np.asarray(TWIN.rmse_mm(policy, jnp.zeros(lifts.size), lifts))


def worst(twin, engine):
    """Return the largest relative error of a lift.

    Below 5 mm it is relative to these: rounding to single precision alone changes a lift of 2 mm
    by 0.04 mm.
    """
    return (np.abs(twin - engine) / np.maximum(engine, 5.0)).max()


@pytest.fixture(scope="module")
def drawn():
    return stack_touch([draw_touch(scenario, seed) for scenario, seed in LIFTS])


@pytest.mark.parametrize("policy", [leading(0.6), yielding], ids=["leading", "yielding"])
def test_each_lift_with_hurdles_is_that_of_the_engine(drawn, policy):
    engine, twin = played(policy), in_twin(policy, drawn)
    assert abs(twin.mean() / engine.mean() - 1) < 0.003
    assert worst(twin, engine) < 0.015


def test_the_agent_that_infers_the_goal_plays_as_in_the_engine(drawn):
    engine, twin = in_engine(AgreeGame), agents_in_twin(TWIN, AgreeGame, drawn)
    assert abs(twin.mean() / engine.mean() - 1) < 0.01


@pytest.mark.slow
def test_the_gradient_is_the_slope_where_nobody_decides_otherwise(drawn):
    @jax.jit
    @jax.value_and_grad
    def error(gain):
        return TWIN.rmse_mm(leading(gain), jnp.zeros(drawn.size), drawn).mean()

    low, high = (float(error(gain)[0]) for gain in (0.598, 0.602))
    assert float(error(0.6)[1]) == pytest.approx((high - low) / 0.004, rel=0.1)


def test_people_who_go_slower_are_found(drawn, monkeypatch):
    engine = played(yielding)
    monkeypatch.setattr(negotiating, "PACE", 7.0)
    assert worst(in_twin(yielding, drawn), engine) > 0.015
