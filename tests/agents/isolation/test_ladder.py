"""Which ways to isolate work here, and what they are worth."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from colift.agents.errors import EvaluatorFault, InputError
from colift.agents.isolation import ladder
from colift.agents.isolation.sandboxed import SandboxedPolicy, close_sandboxes
from colift.agents.submissions.new import write_template


@pytest.fixture
def _unknown():
    """Find out anew which rungs work."""
    ladder.fault.cache_clear()
    yield
    ladder.fault.cache_clear()
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


def test_a_rung_that_works_lets_a_policy_do_nothing_it_should_not(way, rung):
    if rung in ladder.VERIFIABLE:
        assert ladder.holes(rung) == []


def test_resource_limits_alone_leave_all_holes():
    found = " ".join(ladder.holes("limits"))
    for hole in ("reads /etc/shadow", "benchmark", "humans", "writes", "TCP", "UDP", "signals"):
        assert hole in found or (hole == "reads /etc/shadow" and os.geteuid() != 0)
    assert "limits" not in ladder.VERIFIABLE


def test_the_strongest_comes_first():
    assert ladder.rungs()[0] == ladder.strongest()
    order = list(ladder.DESCRIPTIONS)
    assert [*ladder.rungs()] == sorted(ladder.rungs(), key=order.index)


def test_an_unknown_rung_is_refused_with_all_there_are():
    with pytest.raises(InputError, match="'jail'; known: bubblewrap, landlock, limits"):
        ladder.fault("jail")


def test_without_bubblewrap_the_next_rung_is_used(without_bubblewrap):
    assert "bwrap is not installed" in ladder.fault("bubblewrap")
    policy = SandboxedPolicy(name="hold", place="colift.agents.policies.hold:Hold")
    assert policy.isolation == ladder.rungs()[0] != "bubblewrap"
    with policy.agent() as agent:
        agent.reset(1)


def test_a_bubblewrap_that_cannot_start_is_told_in_its_own_words(without_bubblewrap):
    program = without_bubblewrap / "bin" / "bwrap"
    program.write_text("#!/bin/sh\necho 'bwrap: no permission to make a namespace' >&2\nexit 1\n")
    program.chmod(0o755)
    assert "bwrap: no permission to make a namespace" in ladder.fault("bubblewrap")
    assert ladder.strongest() != "bubblewrap"


def test_with_no_rung_at_all_every_reason_is_told(monkeypatch, without_bubblewrap):
    monkeypatch.setattr(ladder, "DESCRIPTIONS", {"bubblewrap": ""})
    with pytest.raises(EvaluatorFault, match=r"no sandbox works here: bubblewrap: .*not installed"):
        ladder.strongest()


def test_the_commands_say_which_rung_was_used(tmp_path):
    write_template(tmp_path / "mine")
    (tmp_path / "bin").mkdir()
    own = {"PATH": str(tmp_path / "bin"), "XDG_CACHE_HOME": str(tmp_path / "cache")}
    mine, next_rung = (
        str(tmp_path / "mine"),
        "landlock" if "landlock" in ladder.rungs() else "limits",
    )
    checked = colift("check", mine, "--jobs", "1", **own)
    assert f"isolation: {next_rung}" in checked.stdout, checked
    refused = colift("run", mine, "--isolation", "bubblewrap", **own)
    assert refused.returncode == 2
    assert "bwrap is not installed" in " ".join(refused.stderr.split())
    assert "Traceback" not in refused.stderr
    out = Path(tmp_path, "out")
    run = ("run", mine, "--suite", "quick-v1", "--seeds", "0:1", "--jobs", "1", "--out", str(out))
    assert colift(*run, **own).returncode == 0
    assert f'"isolation": "{next_rung}"' in (out / "results.json").read_text()


LEFT = """
import os, signal
from pathlib import Path
from colift.agents.isolation.sandboxed import SandboxedPolicy

policy = SandboxedPolicy(name="where", place="where.py:Where", folder=Path("."), rung="limits")
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


def test_the_folder_to_write_in_goes_with_its_owner_even_if_that_is_killed(tmp_path):
    (tmp_path / "where.py").write_text(WHERE)
    done = subprocess.run(
        [sys.executable, "-c", LEFT], cwd=tmp_path, capture_output=True, text=True, timeout=120
    )
    place = Path(done.stdout.strip())
    assert place.name.startswith("colift-"), done.stderr
    end = time.monotonic() + 30
    while place.exists():
        assert time.monotonic() < end
        time.sleep(0.02)
