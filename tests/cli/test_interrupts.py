"""Ctrl-C: what is finished is kept, what is not leaves nothing, and a line says so."""

import json
import os
import re
import signal
import subprocess
import sys
import time

import pytest
from colift.benchmark.execution.journal import journal_path
from colift.cli.evaluation import GO_ON

pytestmark = pytest.mark.slow

INTERRUPTED = """
import signal
from colift.benchmark.episode.lift import Scripted
from colift.cli.main import main

steps = iter(range(10**6))
references = Scripted.references

def interrupted(human):
    if next(steps) == 30:
        signal.raise_signal(signal.SIGINT)
    return references(human)

Scripted.references = interrupted
main()
"""
"""A command that is interrupted in the middle of its first lift, as by Ctrl-C."""


LOADING = """
import signal, sys

class Interrupted:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            signal.raise_signal(signal.SIGINT)

sys.meta_path.insert(0, Interrupted())
from colift.cli.start import start
start()
"""
"""A command that is interrupted while it imports a module."""


@pytest.mark.parametrize(
    "module", ["colift.cli.main", "typer", "colift.cli.nao", "numpy", "pybullet", "rich.table"]
)
def test_ctrl_c_while_a_command_loads_ends_it_without_a_word(module):
    command = [sys.executable, "-c", LOADING.format(module=module), "nao", "run", "blend"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


LOST = """
import signal, time, weakref
from colift.cli import signals

class Library: pass

def interrupted():
    kept = Library()
    called = weakref.ref(kept, lambda _: signal.raise_signal(signal.{number}))
    del kept
    time.sleep(20)

with signals.interruptible() as ending:
    if {once}:
        with signals.until_signalled("ended"):
            interrupted()
    else:
        try:
            interrupted()
        except KeyboardInterrupt:
            print(ending.code)
"""
"""A command that is interrupted while a library's callback runs: Python drops what that raises."""


@pytest.mark.parametrize("once", [True, False])
@pytest.mark.parametrize(("number", "code"), [("SIGTERM", 143), ("SIGINT", 130)])
def test_an_interrupt_inside_a_callback_is_not_lost(once, number, code):
    command = [sys.executable, "-c", LOST.format(once=once, number=number)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=15)
    told = ("", "ended\n") if once else (f"{code}\n", "")
    assert (done.returncode, done.stdout, done.stderr) == (0, *told)


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_ctrl_c_keeps_what_is_finished_and_says_so(tmp_path, jobs):
    started = tmp_path / "started"
    slow_source = tmp_path / "policy.py"
    slow_source.write_text(
        "import time\n"
        "class Mine:\n"
        "    def reset(self, seed): open("
        f"{str(started)!r}, 'a').write('.')\n"
        "    def act(self, observation):\n"
        "        time.sleep(0.003)\n"
        "        return [0.0]\n"
    )
    out = tmp_path / "bundle"
    process = subprocess.Popen(
        [
            *(sys.executable, "-m", "colift.cli", "run", f"{slow_source}:Mine"),
            *("--isolation", "none", "--jobs", jobs, "--out", str(out)),
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    deadline = time.monotonic() + 120
    while not started.exists() or started.stat().st_size < 16:
        assert time.monotonic() < deadline
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGINT)
    stdout, stderr = process.communicate(timeout=120)
    assert process.returncode == 130
    assert "interrupted: partial results of" in stderr
    assert "Traceback" not in stderr
    content = json.loads((out / "results.json").read_text())
    assert not content["complete"]
    assert 0 < content["summary"]["episodes"] < 300
    assert "RMSE" in stdout


@pytest.mark.parametrize(
    "arguments", [("render", "copy"), ("demonstrate", "--jobs", "1", "--lifts", "200")]
)
def test_an_interrupt_is_said_in_a_line(arguments, tmp_path):
    out = tmp_path / ("lift.gif" if "render" in arguments else "lifts.csv")
    process = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, *arguments, "--out", str(out)],
        stderr=subprocess.PIPE,
        text=True,
    )
    _, stderr = process.communicate(timeout=120)
    assert process.returncode == 130
    assert re.fullmatch(rf"interrupted: {re.escape(str(out))} is not (drawn|written)\n", stderr)
    assert not out.exists()


def test_an_interrupted_comparison_can_be_resumed_and_leaves_no_folder(tmp_path):
    out = tmp_path / "new" / "folder"
    command = ("compare", "hold", "copy", "--suite", "quick-v1", "--jobs", "1")
    process = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, *command, "--out", str(out)],
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert process.returncode == 130
    assert process.stderr == f"interrupted: {GO_ON}\n"
    assert list(tmp_path.rglob("*")) == [out.parent, journal_path(out)]


def test_a_comparison_without_a_folder_is_interrupted_as_a_whole():
    command = ("compare", "hold", "copy", "--suite", "quick-v1", "--jobs", "1")
    process = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, *command],
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert (process.returncode, process.stdout) == (130, "")
    assert process.stderr.startswith("interrupted: policies are compared on all lifts or not at")
