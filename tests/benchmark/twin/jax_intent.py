"""The twin of intended poses: the lifts of the engine, with policies that touch and that do not."""

from functools import cache
from itertools import cycle

import jax.numpy as jnp
import numpy as np
import pytest
from colift.agents.tasks.touch.observation import HapticObservation as Seen
from colift.benchmark.suites.catalogue import make_scenario, make_task
from colift.benchmark.twin import haptic_plant
from colift.benchmark.twin.drawing import draw_lifts
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin
from colift.benchmark.world.table import TABLE_LENGTH

from .played import Played, engine_scores

TWIN = TaskTwin(make_task("intent"), make_task("intent").person)

PEOPLE = (210_000, 210_001)
"""Seeds of people and lifts outside all suites."""
LIFTS = [
    (make_scenario(behaviour, f"draw-{seed}", task="intent"), seed)
    for behaviour, seed in zip(
        ("together", "pivot", "counter", "switching"), cycle(PEOPLE), strict=False
    )
]


def yielding(memory, seen):
    return memory, -0.06 * seen[Seen.FORCE]


def level(memory, seen):
    torque = seen[Seen.TORQUE]
    near = seen[Seen.HAND_HEIGHT] + TABLE_LENGTH * torque * (1 - torque**2 / 6)
    return near, 2 * near - memory - seen[Seen.HAND_COMMAND]


@cache
def in_engine(policy):
    """Return the errors in the engine: two tests have the same policy."""
    return np.array([each["rmse_mm"] for each in engine_scores(lambda: Played(policy), LIFTS)])


@pytest.fixture(scope="module")
def drawn():
    return draw_lifts(LIFTS)


def in_twin(policy, lifts):
    return np.asarray(rollout(TWIN, policy, jnp.zeros(lifts.size), lifts).rmse_mm)


@pytest.mark.parametrize("policy", [yielding, level])
def test_each_lift_is_that_of_the_engine(drawn, policy):
    engine, twin = in_engine(policy), in_twin(policy, drawn)
    assert abs(twin.mean() / engine.mean() - 1) < 0.003
    assert np.abs(twin / engine - 1).max() < 0.015


def test_a_wrong_grip_is_found(drawn, monkeypatch):
    engine = in_engine(yielding)
    monkeypatch.setattr(haptic_plant, "FAR_GRIP_STIFFNESS", 1.5)
    assert np.abs(in_twin(yielding, drawn) / engine - 1).max() > 0.015
