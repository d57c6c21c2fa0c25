"""The twin of the ball: the lifts of the engine, with policies that steer and that do not."""

from functools import cache
from itertools import product

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.tasks.ball.ball_game import BallGame
from colift.agents.tasks.ball.observation import BallObservation as Seen
from colift.benchmark.suites.catalogue import make_scenario, make_task
from colift.benchmark.tasks.ball import steering as steering_rule
from colift.benchmark.tasks.ball.task import BALL
from colift.benchmark.twin.agents import play_agents
from colift.benchmark.twin.drawing import draw_lifts
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin
from colift.benchmark.world.table import GRAVITY, TABLE_LENGTH

from .played import Played, engine_scores

TWIN = TaskTwin(make_task("ball"), make_task("ball").person)

PEOPLE = range(210_000, 210_004)
"""Seeds of people and lifts outside all suites."""

BEHAVIOURS = ("ball_smooth", "ball_pause", "ball_smooth_shared", "ball_pause_shared")


def lifts_of(names):
    return [(make_scenario(each, f"draw-{seed}", task="ball"), seed) for each, seed in names]


FEW = lifts_of(zip(BEHAVIOURS, PEOPLE, strict=True))
MANY = lifts_of(product(BEHAVIOURS, PEOPLE))


def steering(gain, following=1.0):
    """Return a policy that goes to the height of the human's end and inclines the table."""

    def policy(last, seen):
        place = seen[Seen.BALL_PLACE]
        error = place - seen[Seen.TARGET_PLACE] + (place - last) / (10 * FRAME)
        height = following * seen[Seen.HUMAN_END] + gain * error
        return place, 0.5 * (height - seen[Seen.HAND_COMMAND])

    return policy


def yielding(last, seen):
    """Give in to the force of the hands but for the ball's weight, and slow the ball down."""
    place = seen[Seen.BALL_PLACE]
    weight = BALL.mass * GRAVITY * (0.5 + place / TABLE_LENGTH)
    speed = (place - last) / (10 * FRAME)
    return place, -0.03 * (seen[Seen.FORCE] - weight) + 0.02 * speed


def idle(last, seen):
    """Stand still: the ball falls."""
    return last, 0.0 * seen[Seen.FORCE]


def in_engine(make, lifts=FEW):
    """Return the errors of the lifts with new agents, and whether each lost the ball."""
    scores = engine_scores(make, lifts)
    return np.array([(each["rmse_mm"], each["fallen"]) for each in scores]).T


@cache
def played(policy):
    """Return the same of a policy: two tests have the same one."""
    return in_engine(lambda: Played(policy))


def in_twin(policy, lifts):
    return np.asarray(rollout(TWIN, policy, jnp.zeros(lifts.size), lifts).rmse_mm)


@pytest.fixture(scope="module")
def drawn():
    return draw_lifts(FEW)


@pytest.mark.parametrize("policy", [steering(0.15), yielding], ids=["steering", "yielding"])
def test_each_lift_with_a_ball_is_that_of_the_engine(drawn, policy):
    (engine, fallen), twin = played(policy), in_twin(policy, drawn)
    assert not fallen.any()
    assert abs(twin.mean() / engine.mean() - 1) < 0.003
    assert np.abs(twin / engine - 1).max() < 0.015


@pytest.mark.slow
def test_an_agent_that_amplifies_differences_has_the_same_mean():
    (engine, _), twin = in_engine(BallGame, MANY), play_agents(BallGame, MANY)
    assert abs(np.log(twin / engine).mean()) < 0.01


def test_a_ball_that_falls_counts_as_in_the_engine(drawn):
    (engine, fallen), twin = played(idle), in_twin(idle, drawn)
    assert fallen.all()
    assert np.abs(twin / engine - 1).max() < 0.015


@pytest.mark.slow
def test_the_gradient_is_the_slope_and_finite_where_the_ball_falls(drawn):
    @jax.jit
    @jax.value_and_grad
    def error(gain, following):
        policy = steering(gain, following)
        return rollout(TWIN, policy, jnp.zeros(drawn.size), drawn).rmse_mm.mean()

    _, slope = error(0.15, 1.0)
    below, above = error(0.148, 1.0)[0], error(0.152, 1.0)[0]
    assert float(slope) == pytest.approx(float(above - below) / 0.004, rel=0.1)
    standing, slope = error(0.0, 0.0)
    assert standing > 150.0
    assert np.isfinite(slope)


def test_people_who_steer_otherwise_are_found(drawn, monkeypatch):
    engine, _ = played(yielding)
    monkeypatch.setattr(steering_rule, "HAND_TIME", 0.3)
    assert np.abs(in_twin(yielding, drawn) / engine - 1).max() > 0.015
