"""Shelves: whatever the number of lifts, memory has their scores, and files have their traces."""

import copy
import dataclasses
import os
import pickle
import tracemalloc
from concurrent.futures import Executor, Future

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.bundle import results, write_bundle
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution import shelf
from colift.benchmark.execution.runner import run_suite

from ...four import FOUR

POLICY = PolicySpec(text="ekf_minimum_jerk")
SUITE = FOUR.with_seeds(0, 1)


class Echo(Executor):
    """Answers each batch with one lift of the engine, under the seeds that are due."""

    def __init__(self, episode):
        self.episode = pickle.dumps(episode)

    def submit(self, batch):
        answer = Answer()
        answer.executor, answer.batch = self, batch
        answer.set_result(None)
        return answer


class Answer(Future):
    def result(self, timeout=None):
        return [
            (
                index,
                dataclasses.replace(
                    pickle.loads(self.executor.episode),
                    seed=seed,
                    behaviour=scenario.behaviour,
                    subject=scenario.subject.name,
                ),
            )
            for index, scenario, seed in self.batch.lifts
        ]


@pytest.fixture(scope="module")
def whole():
    return run_suite(POLICY, SUITE)


@pytest.fixture
def shelved(monkeypatch):
    monkeypatch.setattr(shelf, "IN_MEMORY", 1)
    return run_suite(POLICY, SUITE)


def test_a_shelved_episode_is_the_one_that_was_played(whole, shelved):
    kinds = [type(episode) for episode in shelved.episodes]
    assert kinds == [Episode, *[shelf.Shelved] * (SUITE.size - 1)]
    for one, other in zip(whole.episodes, shelved.episodes, strict=True):
        for form in (other, pickle.loads(pickle.dumps(other)), copy.copy(other)):
            assert form.trace.digest() == one.trace.digest()
            assert repr(form.scores) == repr(one.scores)
            assert (form.behaviour, form.subject, form.trial) == (
                (one.behaviour, one.subject, one.trial)
            )
            assert (form.seed, form.failure, form.log) == (one.seed, one.failure, one.log)
            assert len(form.step_times) == len(one.step_times)
        changed = dataclasses.replace(other, failure="odd")
        assert changed.failure == "odd"
        assert changed.trace.digest() == one.trace.digest()


def test_the_bundle_is_the_same(whole, shelved, tmp_path):
    for name, run in (("whole", whole), ("shelved", shelved)):
        write_bundle(tmp_path / name, run, results(run, {}).plain())
    for name in ("episodes.csv", "traces.npz"):
        assert (tmp_path / "whole" / name).read_bytes() == (
            (tmp_path / "shelved" / name).read_bytes()
        )


def test_nothing_of_it_stays_in_the_folder_of_temporary_files(monkeypatch, tmp_path):
    monkeypatch.setattr(shelf, "IN_MEMORY", 0)
    monkeypatch.setattr(shelf.tempfile, "tempdir", str(tmp_path))
    assert run_suite(POLICY, SUITE).episodes[3].trace.action.any()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_a_long_run_takes_little_more_memory_than_a_short_one(whole, tmp_path, monkeypatch):
    monkeypatch.setattr(shelf, "IN_MEMORY", 4)
    peaks, sizes = [], []
    for seeds in (2, 52):
        suite = SUITE.with_seeds(0, seeds)
        tracemalloc.start()
        run = run_suite(POLICY, suite, executor=Echo(whole.episodes[0]))
        write_bundle(tmp_path / str(seeds), run, {})
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
        assert run.complete
        sizes.append(suite.size)
    trace = whole.episodes[0].trace.human_action.nbytes
    assert peaks[1] - peaks[0] < 0.5 * trace * (sizes[1] - sizes[0])


def test_a_spool_that_cannot_be_written_is_named(monkeypatch, tmp_path, whole):
    monkeypatch.setattr(shelf, "IN_MEMORY", 0)
    monkeypatch.setattr(shelf.tempfile, "tempdir", str(tmp_path / "none"))
    with pytest.raises(InputError, match=f"cannot write to {tmp_path}/none: No such file"):
        shelf.Spool().keep(0, whole.episodes[0])


def test_a_file_that_was_changed_is_not_read_as_if_it_were_whole(tmp_path, whole):
    path = tmp_path / "lifts"
    handle = os.open(path, os.O_RDWR | os.O_CREAT)
    kept = shelf.EpisodeFile(path, handle).keep(0, whole.episodes[0])
    os.truncate(handle, 1000)
    with pytest.raises(InputError, match="lifts has been changed while it was in use"):
        _ = kept.trace
    os.close(handle)
