import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.references.catalogue import REFERENCES
from colift.benchmark.references.oracle import foreknow, oracle_run
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite, make_suite
from colift.benchmark.tasks.rehearsal import Foreknowing


def commanded(path, frames, steps):
    """Return the command at the end of each step, carried out exactly."""
    robot, commands = Foreknowing(path, frames), [0.0]
    robot.reset(0)
    for k in range(steps):
        view = np.array([0.0, 0.0, 0.0, commands[-1], frames * FRAME * k])
        commands.append(commands[-1] + float(robot.act(view)[0]))
    return np.array(commands)


@pytest.mark.parametrize("frames", [2, 10])
def test_who_knows_a_broken_line_follows_it_exactly(frames):
    """A path that is straight within each period can be ramped along."""
    ends = np.array([0.0, 0.01, 0.03, 0.03, 0.02, 0.0])
    path = np.interp(np.arange(1, 5 * frames + 1) / frames, np.arange(6), ends)
    assert commanded(path, frames, 5) == pytest.approx(ends, abs=1e-9)


def test_it_shares_the_error_of_a_curve_between_the_ramps():
    """A chord misses a parabola of curvature c by c T^2 / 8 at most; the best line by less."""
    time = FRAME * np.arange(1, 101)
    commands = commanded(0.5 * time**2, 10, 10)
    line = np.interp(time, 0.1 * np.arange(11), commands)
    chord = np.interp(time, 0.1 * np.arange(11), 0.5 * (0.1 * np.arange(11)) ** 2)
    inside = slice(20, 80)
    off, off_chord = (
        np.sqrt(((each - 0.5 * time**2)[inside] ** 2).mean()) for each in (line, chord)
    )
    assert off < 0.6 * off_chord


def test_rehearsal_leaves_less_than_any_policy_does():
    lift = Lift(make_scenario("jerky", "draw-200000"))
    episode = foreknow(lift, 200_000)
    follower = run_episode(lift, PolicySpec(text="task_model").make(), 200_000)
    lift.close()
    assert episode.failure is None
    assert episode.scores["rmse_mm"] < 1.0
    assert episode.scores["rmse_mm"] < 0.2 * follower.scores["rmse_mm"]


def test_it_meets_the_same_lifts_as_policies_do_and_nothing_else_changes():
    suite = Suite(name="one", scenarios=(make_scenario("smooth", "draw-200001"),), seeds=(200_000,))
    run, other = oracle_run(suite), run_suite(PolicySpec(text="copy"), suite)
    assert run.complete
    assert (run.episodes[0].trace.target == other.episodes[0].trace.target).all()
    again = oracle_run(suite)
    assert (run.episodes[0].trace.state == again.episodes[0].trace.state).all()


@pytest.mark.parametrize("name", list(REFERENCES))
def test_references_are_no_policies(name):
    with pytest.raises(InputError, match="unknown policy"):
        PolicySpec(text=name).check()


def test_references_belong_to_no_suite_timing_but_their_own():
    suite = make_suite("quick-v1").with_timing(0.05, None)
    with pytest.raises(InputError, match="was learned with a latency and a control period"):
        REFERENCES["best_known"](suite, executor=None, progress=lambda episodes: None)
