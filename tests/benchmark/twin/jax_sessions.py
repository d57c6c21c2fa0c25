"""Sessions in the twin: the people of the engine, lift by lift, and gradients through all lifts."""

import dataclasses
from functools import partial

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from colift.agents.agent import RobotObservation
from colift.agents.loading.policy_spec import InMemorySpec, PolicySpec
from colift.agents.policies.copy import Copy
from colift.agents.sessions.session_controller import SessionController
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.execution.sessions import known_lifts
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.session.acquaintance import Acquaintance
from colift.benchmark.tasks.session.telling import TOLD
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.lesson import BatchDraw
from colift.benchmark.training.session_lesson import SessionLesson, SessionPool
from colift.benchmark.twin.agreement import CLOSE, largest_difference
from colift.benchmark.twin.sessions import draw_sessions, play_sessions
from colift.benchmark.twin.task_twin import TaskTwin

WHOLE = make_suite("session-v1")
SUITE = dataclasses.replace(WHOLE, scenarios=WHOLE.scenarios[:4])
SETTINGS = ApgSettings(updates=1, lifts=40, batch=4, units=8, session="remember")


def copied(memory, view):
    return memory, view[RobotObservation.HUMAN_END] - view[RobotObservation.HAND_COMMAND]


def test_a_lift_has_the_numbers_of_the_engine_in_double_precision():
    scenario = WHOLE.at(3).scenario
    human = dataclasses.replace(scenario.human, known=Acquaintance(0.08, 0.02, 0.7))
    assert largest_difference(dataclasses.replace(scenario, human=human), 7, Copy) < CLOSE


@pytest.fixture(scope="module")
def outcome():
    lifts = draw_sessions([(each, SUITE.seeds) for each in SUITE.scenarios])
    twin = TaskTwin.of(SUITE.scenarios)
    return play_sessions(twin, copied, (), lambda memory: memory, lifts)


def test_people_learn_the_same_as_in_the_engine(outcome):
    run = run_suite(PolicySpec(text="copy"), SUITE)
    rmse = np.reshape([each.scores["rmse_mm"] for each in run.episodes], (4, 10))
    found = np.asarray(outcome.rmse_mm).T
    assert found.mean() == pytest.approx(rmse.mean(), rel=0.002)
    assert found == pytest.approx(rmse, rel=0.02)
    traces = {place: each.trace for place, each in enumerate(run.episodes)}
    known = [due.scenario.human.known for due in known_lifts(SUITE, range(40), traces)]
    for name in Acquaintance._fields:
        engine = np.reshape([getattr(each, name) for each in known], (4, 10))[:, 1:]
        there = np.asarray(getattr(outcome.known, name)).T[:, :-1]
        assert there == pytest.approx(engine, abs=0.01)


@pytest.mark.parametrize("kind", ["remember", "forget", "told"])
def test_a_session_differentiates(kind):
    lesson = SessionLesson(SUITE, kind)
    pool, network = lesson.draw(SETTINGS), lesson.first(SETTINGS, 0)
    draw = BatchDraw(4, jax.random.key(0), jnp.float32(0.0))
    loss = jax.value_and_grad(lesson.loss, has_aux=True)
    (error, _), slope = jax.jit(lambda each: loss(each, pool, SETTINGS, draw))(network)
    assert 1.0 < float(error) < 100.0
    leaves = jax.tree.leaves(slope)
    assert all(np.isfinite(each).all() for each in leaves)
    assert all(np.abs(each).max() > 0 for each in leaves)


def test_a_network_that_remembers_meets_the_same_lifts_as_in_the_engine():
    """Its memory at the end of a lift is not that after the end of the longest one."""
    lesson = SessionLesson(SUITE, "remember")
    network = lesson.first(SETTINGS, 0)
    restless = network._replace(output=20.0 * network.output)
    sessions = SessionPool(
        draw_sessions([(each, SUITE.seeds) for each in SUITE.scenarios]), jnp.zeros((10, TOLD, 4))
    )
    found = np.asarray(lesson.play(restless, sessions).rmse_mm).T
    made = partial(SessionController, lesson.check(lesson.weights(restless)))
    spec = InMemorySpec(name="restless", factory=made, source=SessionController)
    run = run_suite(spec, SUITE)
    rmse = np.reshape([each.scores["rmse_mm"] for each in run.episodes], (4, 10))
    assert found == pytest.approx(rmse, rel=0.05)
