"""Which ways to isolate work here, and what they are worth."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from colift.agents.sandbox.host import levels, process
from colift.agents.sandbox.host.connection import Connection
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.agents.sandbox.host.process import command
from colift.agents.submissions.new import write_template
from colift.base.errors import EvaluatorFault, InputError, PolicyError

pytestmark = pytest.mark.slow


@pytest.fixture
def _unknown():
    """Find out anew which levels work."""
    levels.forget()
    yield
    levels.forget()
    close_sandboxes()


@pytest.fixture
def without_bubblewrap(tmp_path, monkeypatch, _unknown):
    """Search programs in a folder that has none."""
    (tmp_path / "bin").mkdir()
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    return tmp_path


def colift(*words, **variables):
    return subprocess.run(
        [sys.executable, "-m", "colift.cli", *words],
        capture_output=True,
        text=True,
        timeout=120,
        env=os.environ | variables,
    )


def test_a_level_that_works_lets_a_policy_do_nothing_it_should_not(level):
    if level in levels.VERIFIABLE:
        assert levels.holes(level) == []


def test_without_namespaces_a_policy_leaves_marks_so_that_is_never_verified():
    assert levels.holes("limits") == ["leaves the time of its last access on files"]
    assert "limits" not in levels.VERIFIABLE


def test_the_levels_of_a_container_are_those_of_its_machine(tmp_path):
    """Its files are layers, of which nothing can be read on condition that it is in memory."""
    lower, upper, work, merged = (tmp_path / name for name in ("lower", "upper", "work", "merged"))
    for each in (lower, upper, work, merged):
        each.mkdir()
    layers = f"lowerdir={lower},upperdir={upper},workdir={work}"
    rights = [] if os.geteuid() == 0 else ["--user", "--map-root-user"]
    mounted = f'mount -t overlay overlay -o {layers} {merged} && exec "$@"'
    within = ["unshare", "--mount", *rights, "sh", "-c", mounted, "sh"]
    if subprocess.run([*within, "true"], capture_output=True).returncode:
        pytest.skip("needs layers of files: overlayfs")
    ask = "from colift.agents.sandbox.host.levels import choose; print(choose().level)"
    done = subprocess.run(
        [*within, sys.executable, "-c", ask],
        capture_output=True,
        text=True,
        timeout=240,
        env=os.environ | {"TMPDIR": str(merged)},
    )
    assert done.stdout == f"{levels.choose().level}\n", done.stderr


@pytest.mark.usefixtures("_unknown", "_without_namespaces")
def test_where_namespaces_cannot_be_had_no_level_is_verifiable_and_each_says_why():
    told = "bubblewrap does not work here: this machine forbids user namespaces.*nor does landlock"
    with pytest.raises(EvaluatorFault, match=told):
        levels.choose(verifiable=True)
    assert levels.choose().level == "limits"
    assert set(levels.choose().passed) == {"bubblewrap", "landlock"}


@pytest.mark.parametrize("missing", ["filter", "Landlock", "filter and Landlock"])
def test_the_probe_finds_what_is_open_when_restrictions_are_missing(missing):
    found = _holes_without(missing)
    if "filter" in missing:
        for hole in (
            "makes sockets",
            "makes handles of processes",
            "takes other processors",
            "shares memory",
            "shares memory of files",
            "makes pipes",
            "makes processes",
            "makes files that no process has",
            "changes times of",
            "changes rights of",
            "locks files of others",
            "locks parts of files",
            "empties the page cache",
            "asks what the page cache holds",
            "asks what is in memory",
            "reads numbers of mounts",
            "changes its priority",
            "opens files in a lift",
            "asks for names in a lift",
            "makes pipes in a lift",
            "makes threads in a lift",
            "wakes others in a lift",
            "reads counters in a lift",
        ):
            assert hole in found
    if "Landlock" in missing:
        for hole in ("reads /tmp", "benchmark", "humans", "writes", "counters", "terminals"):
            assert hole in found
    if missing == "filter and Landlock":
        for hole in ("TCP", "UDP", "signals", "sockets of others"):
            assert hole in found


def _holes_without(missing):
    """Return what the probe finds on the lowest level when restrictions are taken away."""

    def weakened(*arguments, **keywords):
        words = command(*arguments, **keywords)
        place = next(place for place, word in enumerate(words) if "guest.forkserver" in word)
        cut = "import colift.agents.sandbox.guest.restrictions as restrictions\n"
        if "filter" in missing:
            cut += "def none(*_, **__): raise OSError\nrestrictions.filters.install = none\n"
        if "Landlock" in missing:
            cut += "restrictions.landlock.version = lambda: 0\n"
        words[place] = words[place].replace("main(int(handle))", cut + "main(int(handle))")
        return words

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(process, "command", weakened)
        return " ".join(levels.holes("limits"))


def test_the_strongest_comes_first():
    assert levels.working_levels()[0] == levels.strongest()
    order = list(levels.LEVELS)
    assert [*levels.working_levels()] == sorted(levels.working_levels(), key=order.index)


def test_an_unknown_level_is_refused_with_all_there_are():
    with pytest.raises(InputError, match="'jail'; known: bubblewrap, landlock, limits"):
        levels.fault("jail")


def test_without_bubblewrap_the_next_level_is_used(without_bubblewrap):
    assert "bwrap is not installed" in levels.fault("bubblewrap")
    policy = SandboxedPolicy(name="hold", origin="colift.agents.policies.hold:Hold")
    assert policy.isolation == levels.working_levels()[0] != "bubblewrap"
    with policy.agent() as agent:
        agent.reset(1)


def test_a_bubblewrap_that_cannot_start_is_told_in_its_own_words(without_bubblewrap):
    program = without_bubblewrap / "bin" / "bwrap"
    program.write_text("#!/bin/sh\necho 'bwrap: no permission to make a namespace' >&2\nexit 1\n")
    program.chmod(0o755)
    assert "bwrap: no permission to make a namespace" in levels.fault("bubblewrap")
    assert levels.strongest() != "bubblewrap"


def test_with_no_level_at_all_every_reason_is_told(monkeypatch, without_bubblewrap):
    monkeypatch.setattr(levels, "LEVELS", {"bubblewrap": ""})
    with pytest.raises(EvaluatorFault, match=r"bubblewrap does not work here: .*not installed"):
        levels.strongest()


def test_a_board_never_steps_down_to_what_cannot_be_verified(monkeypatch, without_bubblewrap):
    assert levels.choose(verifiable=True).level == levels.working_levels()[0]
    monkeypatch.setattr(levels, "VERIFIABLE", frozenset({"bubblewrap"}))
    assert levels.strongest() != "bubblewrap"
    with pytest.raises(EvaluatorFault, match=r"bubblewrap does not work here: .*not installed"):
        levels.choose(verifiable=True)


@pytest.mark.usefixtures("_unknown")
def test_a_level_that_fails_twice_and_then_works_is_used(monkeypatch):
    real, tried = levels.holes, []

    def busy(name):
        tried.append(name)
        if len(tried) < levels.TRIES:
            raise PolicyError("ended its process (exit code 0)")
        return real(name)

    monkeypatch.setattr(levels, "holes", busy)
    monkeypatch.setattr(levels, "LEVELS", {"limits": ""})
    assert levels.choose().level == tried[0]
    assert len(tried) == levels.TRIES


@pytest.mark.usefixtures("_unknown")
def test_a_failure_is_not_believed_for_good(monkeypatch):
    real, clock = levels.holes, time.monotonic
    monkeypatch.setattr(levels, "holes", lambda name: ["a hole"])
    assert levels.fault("landlock") == "a hole"
    monkeypatch.setattr(levels, "holes", real)
    assert levels.fault("landlock") == "a hole"
    monkeypatch.setattr(time, "monotonic", lambda: clock() + 61.0)
    assert levels.fault("landlock") is None


def test_a_probe_that_is_asked_late_has_not_ended(monkeypatch, level):
    """The answer of a process that has ended must not be lost: it waits to be asked."""
    real = Connection.request

    def late(connection, *arguments):
        time.sleep(0.5)
        return real(connection, *arguments)

    monkeypatch.setattr(Connection, "request", late)
    assert levels.holes(level) == [] or level == "limits"


def test_the_commands_say_which_level_was_used(tmp_path):
    write_template(tmp_path / "mine")
    (tmp_path / "bin").mkdir()
    own = {"PATH": str(tmp_path / "bin"), "XDG_CACHE_HOME": str(tmp_path / "cache")}
    mine, next_level = (
        str(tmp_path / "mine"),
        "landlock" if "landlock" in levels.working_levels() else "limits",
    )
    checked = colift("check", mine, "--jobs", "1", **own)
    assert f"isolation: {next_level}" in checked.stdout, checked
    assert f"isolation {next_level}; bubblewrap does not work here: " in checked.stderr
    assert "bwrap is not installed" in checked.stderr
    refused = colift("run", mine, "--isolation", "bubblewrap", **own)
    assert refused.returncode == 2
    assert "bwrap is not installed" in " ".join(refused.stderr.split())
    assert "Traceback" not in refused.stderr
    out = Path(tmp_path, "out")
    run = ("run", mine, "--suite", "quick-v1", "--seeds", "0:1", "--jobs", "1", "--out", str(out))
    done = colift(*run, **own)
    assert done.returncode == 0
    assert done.stderr.count("bubblewrap does not work here: ") == 1
    assert f'"isolation": "{next_level}"' in (out / "results.json").read_text()


LEFT = """
import os, signal
from pathlib import Path
from colift.agents.sandbox.host.policy import SandboxedPolicy

policy = SandboxedPolicy(
    name="where", origin="where.py:Where", folder=Path("."), isolation="limits"
)
with policy.agent() as agent:
    agent.reset(1)
print(agent.printed, flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""

WHERE = """
import os

class Where:
    def reset(self, seed): print(os.environ["TMPDIR"])
    def act(self, observation): return [0.0]
"""


LINKING = """
import os

class Where:
    def reset(self, seed):
        place = os.environ["TMPDIR"] + "/kept"
        if os.path.lexists(place): raise ValueError("kept")
        os.symlink("/usr/lib", place)
    def act(self, observation): return [0.0]
"""


WRITING = """
import tempfile

class Where:
    def reset(self, seed):
        with tempfile.TemporaryFile() as file: file.write(b"x")
    def act(self, observation): return [0.0]
"""


def test_there_is_a_place_for_temporary_files(tmp_path, level):
    (tmp_path / "where.py").write_text(WRITING)
    policy = SandboxedPolicy(name="w", origin="where.py:Where", folder=tmp_path, isolation=level)
    with policy.agent() as agent:
        agent.reset(1)
    close_sandboxes()


def test_a_link_to_a_folder_is_gone_with_its_lift(tmp_path):
    (tmp_path / "where.py").write_text(LINKING)
    policy = SandboxedPolicy(name="w", origin="where.py:Where", folder=tmp_path, isolation="limits")
    for _ in range(2):
        with policy.agent() as agent:
            agent.reset(1)
    close_sandboxes()


def test_the_folder_to_write_in_goes_with_its_owner_even_if_that_is_killed(tmp_path):
    (tmp_path / "where.py").write_text(WHERE)
    done = subprocess.run(
        [sys.executable, "-c", LEFT], cwd=tmp_path, capture_output=True, text=True, timeout=120
    )
    place = Path(done.stdout.strip()).parent
    assert place.name.startswith("colift-"), done.stderr
    end = time.monotonic() + 30
    while place.exists():
        assert time.monotonic() < end
        time.sleep(0.02)
