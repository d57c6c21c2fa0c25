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
from colift.benchmark.twin.agents import play_agents
from colift.benchmark.twin.drawing import draw_lifts
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin
from colift.benchmark.world.table import TABLE_LENGTH

from .played import Played, engine_scores

TWIN = TaskTwin(make_task("agree"), make_task("agree").person)

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
    return np.asarray(rollout(TWIN, policy, jnp.zeros(lifts.size), lifts).rmse_mm)


def worst(twin, engine):
    """Return the largest relative error of a lift.

    Below 5 mm it is relative to these: rounding to single precision alone changes a lift of 2 mm
    by 0.04 mm.
    """
    return (np.abs(twin - engine) / np.maximum(engine, 5.0)).max()


@pytest.fixture(scope="module")
def drawn():
    return draw_lifts(LIFTS)


@pytest.mark.parametrize("policy", [leading(0.6), yielding], ids=["leading", "yielding"])
def test_each_lift_with_hurdles_is_that_of_the_engine(drawn, policy):
    engine, twin = played(policy), in_twin(policy, drawn)
    assert abs(twin.mean() / engine.mean() - 1) < 0.003
    assert worst(twin, engine) < 0.015


def test_the_agent_that_infers_the_goal_plays_as_in_the_engine():
    engine, twin = in_engine(AgreeGame), play_agents(AgreeGame, LIFTS)
    assert abs(twin.mean() / engine.mean() - 1) < 0.01


@pytest.mark.slow
def test_the_gradient_is_the_slope_where_nobody_decides_otherwise(drawn):
    @jax.jit
    @jax.value_and_grad
    def error(gain):
        return rollout(TWIN, leading(gain), jnp.zeros(drawn.size), drawn).rmse_mm.mean()

    low, high = (float(error(gain)[0]) for gain in (0.598, 0.602))
    assert float(error(0.6)[1]) == pytest.approx((high - low) / 0.004, rel=0.1)


def test_people_who_go_slower_are_found(drawn, monkeypatch):
    engine = played(yielding)
    monkeypatch.setattr(negotiating, "PACE", 7.0)
    assert worst(in_twin(yielding, drawn), engine) > 0.015
