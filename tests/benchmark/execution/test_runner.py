"""Running a suite: the same result in any process, partial results, third-party policies."""

import hashlib
import multiprocessing
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.execution.runner import InterruptedRunError, run_suite
from colift.benchmark.suites.suite import make_suite

QUICK = "quick-v1"

FRESH = """
import dataclasses
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite
suite = make_suite("quick-v1")
suite = dataclasses.replace(suite, scenarios=suite.scenarios[7:8])
print(run_suite(PolicySpec(text="copy"), suite).episodes[0].trace.digest())
"""


@pytest.fixture(scope="module")
def alone():
    return run_suite(PolicySpec(text="copy"), make_suite(QUICK))


def digests(run):
    return [episode.trace.digest() for episode in run.episodes]


def test_episodes_come_in_the_order_of_the_suite(alone):
    suite = make_suite(QUICK)
    wanted = [(s.behaviour, s.subject.name, seed) for s in suite.scenarios for seed in suite.seeds]
    assert [(e.behaviour, e.subject, e.seed) for e in alone.episodes] == wanted
    assert alone.complete


@pytest.mark.slow
@pytest.mark.parametrize("jobs", [1, 2, 3])
def test_any_number_of_workers_gives_the_same_bits(alone, jobs):
    context = multiprocessing.get_context("forkserver")
    with ProcessPoolExecutor(jobs, mp_context=context) as pool:
        pooled = run_suite(PolicySpec(text="copy"), make_suite(QUICK), executor=pool)
    assert digests(pooled) == digests(alone)


def test_a_fresh_process_gives_the_same_bits(alone):
    done = subprocess.run([sys.executable, "-c", FRESH], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == digests(alone)[7]


def test_progress_counts_every_episode(alone):
    counted = []
    run_suite(PolicySpec(text="hold"), make_suite(QUICK), progress=counted.append)
    assert sum(counted) == len(alone.episodes)


@pytest.mark.parametrize("last", [4, 12])
def test_an_interrupt_ends_the_run_and_keeps_what_is_finished(alone, last):
    done = []

    def interrupt(episodes):
        done.append(episodes)
        if len(done) == last:
            raise KeyboardInterrupt

    with pytest.raises(InterruptedRunError, match=f"interrupted after {last} of 12") as caught:
        run_suite(PolicySpec(text="copy"), make_suite(QUICK), progress=interrupt)
    assert digests(caught.value.run) == digests(alone)[:last]


def test_a_policy_from_a_file_runs_in_workers_too(tmp_path):
    source = tmp_path / "mine.py"
    source.write_text(
        "import numpy as np\n"
        "class Mine:\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation): return np.array([observation[0] - observation[3]])\n"
    )
    spec = PolicySpec(text=f"{source}:Mine")
    context = multiprocessing.get_context("forkserver")
    with ProcessPoolExecutor(2, mp_context=context) as pool:
        pooled = run_suite(spec, make_suite(QUICK), executor=pool)
    assert digests(pooled) == digests(run_suite(PolicySpec(text="copy"), make_suite(QUICK)))
    assert spec.name == "Mine"


def test_an_unknown_policy_is_refused_before_anything_runs():
    with pytest.raises(InputError, match=r"unknown policy 'nonesuch'"):
        run_suite(PolicySpec(text="nonesuch"), make_suite(QUICK))


def test_the_digest_of_a_trace_is_a_sha256(alone):
    assert len(digests(alone)[0]) == len(hashlib.sha256().hexdigest())
