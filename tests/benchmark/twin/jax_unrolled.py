"""Loops that are unrolled, as on a GPU, give what loops give."""

import jax.numpy as jnp
import numpy as np
import pytest
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.twin import inner
from colift.benchmark.twin.drawing import draw_lifts
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin


def keeping(memory, view):
    return memory, 0.0 * view[0]


@pytest.mark.parametrize("task", ["level", "ball"])
def test_an_unrolled_lift_is_the_same_lift(task, monkeypatch):
    behaviour = {"level": "smooth", "ball": "ball_smooth"}[task]
    scenarios = [make_scenario(behaviour, person, task=task) for person in ("S1", "S3")]
    lifts, twin = draw_lifts([(each, 4) for each in scenarios]), TaskTwin.of(scenarios)
    found = rollout(twin, keeping, jnp.zeros(2), lifts).rmse_mm
    monkeypatch.setattr(inner, "UNROLLED", {"cpu": 10, "gpu": 1})
    other = rollout(twin, keeping, jnp.zeros(2), lifts).rmse_mm
    np.testing.assert_allclose(other, found, rtol=1e-5)
