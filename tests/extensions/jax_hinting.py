"""Another package's task in the twin: it is that of the engine, and a network learns it there."""

import contextlib

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from colift.agents.policies.copy import Copy
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.training import apg
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.lessons import lesson_of
from colift.benchmark.twin.agreement import CLOSE, largest_difference
from colift.benchmark.twin.drawing import draw_lifts
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin

from . import hinting

WITHOUT_A_SUITE, *_ = hinting.ENTRY_POINTS.partition("[colift.suites]")


@pytest.fixture
def entry_points():
    return hinting.ENTRY_POINTS


@pytest.fixture(autouse=True)
def installed(install, entry_points):
    install(hinting.__file__, entry_points)


def lifts():
    return [(make_scenario("smooth", f"draw-{210_000 + i}", task="hint"), i) for i in range(3)]


def test_its_rules_are_the_same_in_both():
    assert largest_difference(*lifts()[0], Copy) < CLOSE


def test_its_lifts_are_those_of_the_engine_and_gradients_are_slopes():
    twin, drawn = TaskTwin.of([scenario for scenario, _ in lifts()]), draw_lifts(lifts())

    @jax.jit
    def errors(gain):
        def policy(memory, seen):
            return memory, gain * (seen[0] - seen[3])

        return rollout(twin, policy, jnp.zeros(drawn.size), drawn).rmse_mm

    class Following:
        def reset(self, seed):
            pass

        def act(self, observation):
            return np.array([0.8 * (observation[0] - observation[3])])

    engine = []
    for scenario, seed in lifts():
        with contextlib.closing(Lift(scenario)) as lift:
            engine.append(run_episode(lift, Following(), seed).scores["rmse_mm"])
    assert np.asarray(errors(0.8)) == pytest.approx(np.array(engine), rel=2e-3)
    slope = jax.jit(jax.grad(lambda gain: errors(gain).mean()))(0.8)
    assert slope == pytest.approx(float((errors(0.81) - errors(0.79)).mean() / 0.02), rel=0.05)


def test_a_network_learns_it_in_the_twin():
    settings = ApgSettings(task="hint", updates=2, lifts=4, batch=4, units=3)
    *_, last = apg.updates(settings, 0)
    lesson = lesson_of("hint")
    errors = lesson.errors(last.learner.network, lesson.draw(settings))
    assert np.isfinite(errors).all()


@pytest.mark.parametrize(
    ("entry_points", "following"),
    [
        (
            hinting.ENTRY_POINTS,
            "colift run t/seed-0 --suite hint-v1, or colift check t/seed-0 --suite hint-v1",
        ),
        (WITHOUT_A_SUITE, "colift render t/seed-0 --task hint --out lift.png"),
    ],
)
def test_the_command_says_what_plays_its_policy(colift, following):
    tiny = ("--updates", "1", "--lifts", "2", "--batch", "2", "--units", "2")
    done = colift("train", "apg", "--task", "hint", "--out", "t", *tiny)
    assert done.returncode == 0, done.stderr
    assert done.stdout.endswith(f"\nNext: {following}\n")
