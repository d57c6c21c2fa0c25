"""The journal of a run: kept as it goes, found again, and never mistaken for another run's."""

import os
import signal
import subprocess
import sys

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.execution.journal import journal_path, open_journal
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite

RUN = {"policy": "copy", "suite digest": "abc", "isolation": "none", "colift": "0123"}

RUNNING = """
import os, resource, signal, sys
from pathlib import Path
from colift.base.errors import InputError
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.journal import open_journal
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite

suite = make_suite("quick-v1").with_seeds(0, 1)
"""
KILLED = """
with open_journal(Path(sys.argv[1]), {}, resume=False) as journal:
    def keep(place, episode):
        journal.keep(place, episode)
        if place == 2:
            os.kill(os.getpid(), signal.SIGKILL)
    run_suite(PolicySpec(text="copy"), suite, keep=keep)
"""
FULL = """
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (150_000, 150_000))
try:
    with open_journal(Path(sys.argv[1]), {}, resume=False) as journal:
        run_suite(PolicySpec(text="copy"), suite, keep=journal.keep)
except InputError as error:
    print(error)
"""


@pytest.fixture(scope="module")
def episodes():
    return run_suite(PolicySpec(text="copy"), make_suite("quick-v1").with_seeds(0, 1)).episodes


@pytest.fixture
def bundle(tmp_path):
    return tmp_path / "bundle"


@pytest.fixture
def interrupted(bundle, episodes):
    """A bundle whose run was interrupted after two episodes; they came in another order."""
    with open_journal(bundle, RUN, resume=False) as journal:
        journal.keep(3, episodes[3])
        journal.keep(1, episodes[1])
    return bundle


def digests(done):
    return {place: episode.trace.digest() for place, episode in done.items()}


def test_a_new_run_has_nothing_done_and_leaves_nothing_when_removed(bundle, episodes):
    with open_journal(bundle, RUN, resume=False) as journal:
        assert journal.done == {}
        journal.keep(0, episodes[0])
        assert journal_path(bundle).parent == bundle.parent
        journal.remove()
    assert list(bundle.parent.iterdir()) == []


def test_an_interrupted_run_goes_on_where_it_was(interrupted, episodes):
    for left in (0, 2):
        with open_journal(interrupted, RUN, resume=True) as journal:
            wanted = {place: episodes[place].trace.digest() for place in (3, 1, 0, 2)[: 2 + left]}
            assert digests(journal.done) == wanted
            if not left:
                journal.keep(0, episodes[0])
                journal.keep(2, episodes[2])


@pytest.mark.parametrize("cut", [1, 100, 20_000])
def test_a_torn_record_is_dropped_and_its_episode_kept_anew(interrupted, episodes, cut):
    path = journal_path(interrupted)
    whole = path.read_bytes()
    os.truncate(path, path.stat().st_size - cut)
    with open_journal(interrupted, RUN, resume=True) as journal:
        assert digests(journal.done) == {3: episodes[3].trace.digest()}
        journal.keep(1, episodes[1])
    assert path.read_bytes() == whole


@pytest.mark.parametrize("name", list(RUN))
def test_another_run_is_refused_and_the_difference_named(interrupted, name):
    before = journal_path(interrupted).read_bytes()
    other = {**RUN, name: "other"}
    told = f"the interrupted run had {name} '{RUN[name]}', this one has 'other'"
    with (
        pytest.raises(InputError, match=told),
        open_journal(interrupted, other, resume=True),
    ):
        pass
    assert journal_path(interrupted).read_bytes() == before


def test_what_only_one_run_has_is_a_difference(interrupted):
    with (
        pytest.raises(InputError, match="had gpu 'none', this one has 'big'"),
        open_journal(interrupted, {**RUN, "gpu": "big"}, resume=True),
    ):
        pass
    fewer = {name: RUN[name] for name in list(RUN)[:-1]}
    with (
        pytest.raises(InputError, match="had colift '0123', this one has 'none'"),
        open_journal(interrupted, fewer, resume=True),
    ):
        pass


def test_an_interrupted_run_is_not_overwritten(interrupted):
    with (
        pytest.raises(InputError, match="holds 2 lifts of an interrupted run; resume it"),
        open_journal(interrupted, RUN, resume=False),
    ):
        pass


def test_there_must_be_something_to_resume(bundle):
    with (
        pytest.raises(InputError, match="there is no interrupted run of"),
        open_journal(bundle, RUN, resume=True),
    ):
        pass
    assert list(bundle.parent.iterdir()) == []


def test_a_run_without_a_finished_episode_is_begun_anew(bundle):
    for name in ("copy", "hold", "blend"):
        with open_journal(bundle, {**RUN, "policy": name}, resume=False) as journal:
            assert journal.done == {}


@pytest.mark.parametrize("content", [b"my notes", b"\x00" * 20, b"trial,t_s,z_m\n" * 10])
@pytest.mark.parametrize("resume", [False, True])
def test_the_file_of_another_is_left_alone(bundle, content, resume):
    path = journal_path(bundle)
    path.write_bytes(content)
    with (
        pytest.raises(InputError, match="is not a journal of colift"),
        open_journal(bundle, RUN, resume=resume),
    ):
        pass
    assert path.read_bytes() == content


def test_two_processes_cannot_be_at_one_run(interrupted):
    with (
        open_journal(interrupted, RUN, resume=True),
        pytest.raises(InputError, match=r"another process with the same run writes to"),
        open_journal(interrupted, RUN, resume=True),
    ):
        pass


def test_what_a_killed_process_kept_is_there(bundle, episodes):
    done = subprocess.run([sys.executable, "-c", RUNNING + KILLED, str(bundle)])
    assert done.returncode == -signal.SIGKILL
    with open_journal(bundle, {}, resume=True) as journal:
        assert digests(journal.done) == {k: episodes[k].trace.digest() for k in range(3)}


def test_a_full_disk_is_said_and_what_was_kept_before_can_be_resumed(bundle, episodes):
    done = subprocess.run(
        [sys.executable, "-c", RUNNING + FULL, str(bundle)],
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == f"cannot write to {journal_path(bundle)}: File too large\n"
    with open_journal(bundle, {}, resume=True) as journal:
        kept = len(journal.done)
        assert 0 < kept < len(episodes)
        assert digests(journal.done) == {k: episodes[k].trace.digest() for k in range(kept)}
