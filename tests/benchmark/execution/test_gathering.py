"""Tasks are played again when the machine fails, and only then."""

import os
import signal
import time
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import nullcontext
from dataclasses import dataclass, fields

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import EvaluatorFault, InputError
from colift.benchmark.bundle.table import table_row
from colift.benchmark.execution.batches import AHEAD, Batch, Faults, batches, run_batches
from colift.benchmark.execution.pool import process_pool
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite

from ...four import FOUR

SUITE = FOUR.with_seeds(0, 2)

FAILING = """
import os
from pathlib import Path
from colift.base.errors import EvaluatorFault
from colift.agents.policies.copy import Copy

here = Path(__file__).parent

class Failing(Copy):
    def reset(self, seed):
        super().reset(seed)
        with (here / "resets").open("a") as file:
            file.write(".")
        self.steps = 0

    def act(self, observation):
        self.steps += 1
        resets = (here / "resets").stat().st_size
        if self.steps == 10 and {when}:
            {fails}
        return super().act(observation)
"""
NEVER, ONCE, TWICE, ALWAYS = "False", "resets == 2", "resets in (2, 3)", "resets >= 2"
FAULT = 'raise EvaluatorFault("the disk burns")'
KILLED = "os.kill(os.getpid(), 9)"


def told(run):
    return [(e.trace.digest(), repr(table_row(e, run.suite.metrics)), e.log) for e in run.episodes]


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    path = tmp_path_factory.mktemp("failing") / "policy.py"
    path.write_text(FAILING.format(when=NEVER, fails=FAULT))
    return run_suite(PolicySpec(text=f"{path}:Failing"), SUITE)


@pytest.fixture
def failing(tmp_path):
    """Return what writes a policy that fails, by the number of episodes that were begun."""

    def write(when, fails):
        path = tmp_path / "policy.py"
        path.write_text(FAILING.format(when=when, fails=fails))
        return PolicySpec(text=f"{path}:Failing")

    return write


def resets(folder):
    return (folder / "resets").stat().st_size


def test_a_batch_has_lifts_of_several_people():
    suite = make_suite("standard-v1")  # Nobody lifts twice in the same way.
    found = list(batches(PolicySpec(text="copy"), suite, done={7}))
    assert [len(batch.lifts) for batch in found] == [5, 4, *[5] * 58]
    lifts = [due for batch in found for due in batch.lifts]
    assert [due.place for due in lifts] == [i for i in range(suite.size) if i != 7]
    expected = [(each, seed) for each in suite.scenarios for seed in suite.seeds]
    assert all((due.scenario, due.seed) == expected[due.place] for due in lifts)


def test_a_fault_of_the_machine_changes_nothing_but_the_count(failing, undisturbed, tmp_path):
    kept = []
    run = run_suite(failing(TWICE, FAULT), SUITE, keep=lambda place, episode: kept.append(place))
    assert told(run) == told(undisturbed)
    assert (run.faults, undisturbed.faults) == (2, 0)
    assert kept == list(range(SUITE.size))
    assert resets(tmp_path) == SUITE.size + 2


@pytest.mark.parametrize(("pool", "finished"), [(nullcontext, 1), (lambda: process_pool(1), 0)])
def test_a_fault_that_stays_ends_the_run_and_charges_nobody(failing, pool, finished):
    kept = []
    spec = failing(ALWAYS, FAULT)
    with (
        pool() as executor,
        pytest.raises(EvaluatorFault, match="tried 3 times: the disk burns"),
    ):
        run_suite(spec, SUITE, keep=lambda *each: kept.append(each), executor=executor)
    assert len(kept) == finished


@pytest.mark.slow
@pytest.mark.parametrize("fails", [FAULT, KILLED, "os._exit(0)"])
def test_whatever_ends_a_worker_changes_nothing_but_the_count(failing, undisturbed, fails):
    with process_pool(1) as pool:
        run = run_suite(failing(ONCE, fails), SUITE, executor=pool)
    assert told(run) == told(undisturbed)
    assert run.faults == 1
    assert all(episode.failure is None for episode in run.episodes)


def test_a_pool_that_breaks_with_its_worker_ends_the_run(failing):
    with (
        ProcessPoolExecutor(1) as pool,
        pytest.raises(EvaluatorFault, match="cannot continue: BrokenProcessPool"),
    ):
        run_suite(failing(ONCE, KILLED), SUITE, executor=pool)


def test_workers_that_are_killed_from_outside_change_nothing(failing, undisturbed):
    with process_pool(2) as pool:
        killed = []

        def kill(episodes):
            if not killed:
                killed.extend(pool.processes())
                for pid in killed:
                    os.kill(pid, signal.SIGKILL)

        run = run_suite(failing(NEVER, FAULT), SUITE, executor=pool, progress=kill)
    assert len(killed) == 2
    assert told(run) == told(undisturbed)
    assert run.faults >= 1


@dataclass(frozen=True, kw_only=True)
class Refused(Batch):
    """A task that its worker refuses."""

    def __call__(self):
        raise InputError("this worker has another colift")


def test_what_a_user_gave_wrong_is_not_tried_again():
    faults = Faults()
    (first, *_) = batches(PolicySpec(text="copy"), SUITE)
    refused = Refused(**{each.name: getattr(first, each.name) for each in fields(first)})
    with process_pool(1) as pool, pytest.raises(InputError, match="another colift"):
        list(run_batches([refused], pool, faults))
    assert faults.count == 0


def test_no_more_batches_wait_than_keep_the_workers_busy():
    waiting = []

    class Holding(Executor):
        workers = 2

        def submit(self, fn, /, *args, **kwargs):
            waiting.append(Future())
            return waiting[-1]

    held = run_batches(
        batches(PolicySpec(text="copy"), FOUR.with_seeds(0, 60)), Holding(), Faults()
    )
    with ThreadPoolExecutor(1) as thread:
        first = thread.submit(next, held)
        while len(waiting) < AHEAD * Holding.workers:
            time.sleep(0.001)
        waiting[0].set_result([(0, "a lift")])
        assert first.result() == (0, "a lift")
        second = thread.submit(next, held)
        waiting[1].set_result([(1, "another")])
        second.result()
    assert len(waiting) == AHEAD * Holding.workers + 1
    held.close()
