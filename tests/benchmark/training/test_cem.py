"""The cross-entropy method: what it learns, and that nothing but settings and seed decides it."""

from functools import partial

import numpy as np
import pytest
from colift.agents.submissions.network.policy import Policy
from colift.agents.submissions.submission import read_submission
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.execution.pool import process_pool
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.training import cem, validation
from colift.benchmark.training.cem import CemSettings, start, train_cem
from colift.benchmark.training.course import open_course
from colift.benchmark.training.data import Timing, scenario
from colift.benchmark.training.result import checked_network
from colift.benchmark.training.validation import lift_together, validation_error

TINY = CemSettings(generations=2, population=4, elite=2, lifts=2, steps=2, hidden=1)


@pytest.fixture(autouse=True)
def two_lifts_to_validate(monkeypatch):
    monkeypatch.setattr(validation, "VALIDATION_SEEDS", validation.VALIDATION_SEEDS[:2])


def weights(course):
    with np.load(course.policy / "weights.npz") as stored:
        return {name: stored[name] for name in stored.files}


def same(one, other):
    return one.keys() == other.keys() and all((one[k] == other[k]).all() for k in one)


@pytest.fixture(scope="module")
def trained(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(validation, "VALIDATION_SEEDS", validation.VALIDATION_SEEDS[:2])
        course = open_course(tmp_path_factory.mktemp("trained") / "out", "cem", TINY, 0)
        train_cem(TINY, course)
    return course


@pytest.mark.slow
def test_the_weights_are_the_same_with_workers_and_others_with_another_seed(trained, tmp_path):
    again = open_course(tmp_path, "cem", TINY, 0)
    with process_pool(2) as pool:
        train_cem(TINY, again, executor=pool)
    assert same(weights(again), weights(trained))
    other = open_course(tmp_path, "cem", TINY, 1)
    train_cem(TINY, other)
    assert not same(weights(other), weights(trained))


def test_an_interrupted_training_resumes_to_the_same_weights(trained, tmp_path):
    def stop(point):
        raise KeyboardInterrupt

    course = open_course(tmp_path, "cem", TINY, 0, stop)
    with pytest.raises(KeyboardInterrupt):
        train_cem(TINY, course)
    assert not course.policy.exists()
    course = open_course(tmp_path, "cem", TINY, 0)
    done = []
    train_cem(TINY, course, progress=done.append)
    assert done[0] == TINY.lifts
    assert sum(done) == TINY.generations * TINY.lifts
    assert same(weights(course), weights(trained))
    assert [p.rmse_mm for p in course.curve] == [p.rmse_mm for p in trained.curve]


def test_the_first_distribution_extrapolates_and_the_errors_are_the_benchmark_s(trained):
    mean, _ = start(TINY, 0)
    seed = 100_003
    [error], steps = lift_together([cem.policy(TINY, mean)], seed)
    lift = Lift(scenario(seed, BEHAVIOURS, Timing()))
    policy = read_submission(trained.policy).trusted()
    played = run_episode(lift, policy.make(), seed)
    [own], _ = lift_together([partial(Policy, checked_network(weights(trained)))], seed)
    assert own == pytest.approx(played.scores["rmse_mm"])
    assert steps * lift.frames_per_step == lift.horizon
    assert own != error
    lift.close()


@pytest.mark.slow
def test_the_best_candidates_lead(tmp_path):
    """With candidates that are hardly better than chance, the error would not fall."""
    settings = CemSettings(generations=3, population=12, elite=3, lifts=2, steps=2, hidden=1)
    course = open_course(tmp_path, "cem", settings, 0)
    mean, _ = start(settings, 0)
    before = validation_error(cem.policy(settings, mean))
    train_cem(settings, course)
    assert course.curve[-1].rmse_mm < 0.95 * before


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"lifts": 0}, "lifts must be at least 1, got 0"),
        ({"population": 3, "elite": 3}, "elite must be below population, 3, got 3"),
    ],
)
def test_settings_out_of_range_are_refused(change, told):
    with pytest.raises(InputError, match=told):
        CemSettings(**change)
