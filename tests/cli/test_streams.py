"""Streams that are closed, full, narrow or not UTF-8, and signals: no traceback, no lost result."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest

pytestmark = pytest.mark.slow

COLIFT = f"{sys.executable} -m colift"
QUICK = "run copy --suite quick-v1 --seeds 0:1 --jobs 1"


def shell(line, cwd, **environment):
    """Run a line of Bash; return its end."""
    inherited = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    return subprocess.run(
        ["bash", "-c", line],
        cwd=cwd,
        env={**inherited, **environment},
        capture_output=True,
        timeout=240,
    )


@pytest.mark.parametrize("command", ["list", QUICK])
@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "cp1252"])
def test_a_stream_that_is_not_utf_8_gets_the_result(tmp_path, command, encoding):
    done = shell(f"{COLIFT} {command}", tmp_path, PYTHONIOENCODING=encoding)
    assert (done.returncode, done.stderr) == (0, b"")
    assert (b"blend" if command == "list" else b"two people") in done.stdout
    done.stdout.decode(encoding)


@pytest.mark.parametrize("command", ["list", "list blend", QUICK, "--help", "--version"])
@pytest.mark.parametrize("closed", ["2>&-", "<&-", "<&- 2>&-"])
def test_a_closed_stream_changes_nothing_of_the_result(tmp_path, command, closed):
    done = shell(f"{COLIFT} {command} {closed}", tmp_path)
    whole = shell(f"{COLIFT} {command}", tmp_path)
    assert (done.returncode, whole.returncode) == (0, 0)
    if "run" not in command:  # Its table has the policy's time per step.
        assert done.stdout == whole.stdout
    assert len(done.stdout.splitlines()) == len(whole.stdout.splitlines()) > 0


def test_a_closed_stderr_takes_no_other_files_place(tmp_path):
    done = shell(f"{COLIFT} {QUICK} --out kept 2>&-", tmp_path)
    assert done.returncode == 0
    assert shell(f"{COLIFT} verify kept", tmp_path).returncode == 0
    assert shell(f"{COLIFT} run nonesuch 2>&-", tmp_path).stdout == b""


@pytest.mark.parametrize("command", ["list", QUICK, "--help"])
def test_a_closed_stdout_and_a_pipe_that_ends_are_no_error(tmp_path, command):
    done = shell(f"{COLIFT} {command} >&-", tmp_path)
    assert (done.returncode, done.stderr) == (0, b"")
    done = shell(f"set -o pipefail; {COLIFT} {command} | true", tmp_path)
    assert (done.returncode, done.stderr) == (0, b"")


def test_a_full_device_is_a_line_and_the_bundle_is_kept(tmp_path):
    done = shell(f"{COLIFT} {QUICK} --out kept >/dev/full", tmp_path)
    assert done.returncode == 1
    assert done.stderr.startswith(b"error: ")
    assert b"No space left on device" in done.stderr
    assert done.stderr.count(b"\n") == 1
    assert json.loads((tmp_path / "kept" / "results.json").read_text())["complete"]


def test_lines_in_a_pipe_are_whole_and_in_a_terminal_fit(tmp_path):
    whole = shell(f"{COLIFT} list", tmp_path).stdout.decode().splitlines()
    (blend,) = [line for line in whole if line.startswith("  blend")]
    assert blend.endswith("(Thobbi, Gu, Sheng 2011).")
    assert max(map(len, whole)) > 100
    narrow = shell(f"{COLIFT} list", tmp_path, COLUMNS="60").stdout.decode().splitlines()
    assert max(map(len, narrow)) <= 60
    shell(f"{COLIFT} new mine", tmp_path)
    checks = shell(f"{COLIFT} check mine --jobs 1", tmp_path).stdout.decode().splitlines()
    assert [line[:6].strip() in {"ok", "warn", "Next:"} for line in checks] == [True] * len(checks)


SLOW = """
import time
class Slow:
    def reset(self, seed): open({started!r}, "a").write(".")
    def act(self, observation):
        time.sleep(0.01)
        return [0.0]
"""


@pytest.fixture
def slow(tmp_path):
    """Return how to start a command with a slow policy, and wait until it lifts."""
    started = tmp_path / "started"
    (tmp_path / "slow.py").write_text(SLOW.format(started=str(started)))

    def start(*arguments, lifts=3):
        process = subprocess.Popen(
            [sys.executable, "-m", "colift", *arguments],
            cwd=tmp_path,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        end = time.monotonic() + 120
        while not started.exists() or started.stat().st_size < lifts:
            assert process.poll() is None
            assert time.monotonic() < end
            time.sleep(0.05)
        return process

    return start


@pytest.mark.parametrize(
    ("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)], ids=["ctrl-c", "sigterm"]
)
def test_both_signals_keep_what_is_finished(slow, tmp_path, number, code):
    options = ("--isolation", "none", "--jobs", "1", "--out", "kept")
    process = slow("run", "slow.py:Slow", *options, lifts=6)
    process.send_signal(number)
    told, errors = process.communicate(timeout=120)
    assert process.returncode == code
    assert errors.startswith("interrupted: partial results of ")
    assert " of 300 lifts, of smooth alone; the finished lifts are kept" in errors
    assert "Traceback" not in errors
    assert "smooth" in told
    assert not json.loads((tmp_path / "kept" / "results.json").read_text())["complete"]


@pytest.mark.parametrize(
    ("suffix", "number"),
    [
        ("gif", signal.SIGTERM),
        ("webp", signal.SIGTERM),
        ("mp4", signal.SIGTERM),
        ("mp4", signal.SIGINT),
    ],
)
def test_a_film_that_is_ended_leaves_nothing(tmp_path, suffix, number):
    if suffix == "mp4":
        pytest.importorskip("imageio_ffmpeg")
    begun = subprocess.Popen(
        [sys.executable, "-m", "colift", "render", "copy", "--out", f"lift.{suffix}"],
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        text=True,
    )
    end = time.monotonic() + 300
    while not list(tmp_path.iterdir()):
        assert begun.poll() is None
        assert time.monotonic() < end
        time.sleep(0.02)
    begun.send_signal(number)
    _, errors = begun.communicate(timeout=60)
    assert begun.returncode == 128 + number
    assert errors == f"interrupted: lift.{suffix} is not drawn\n"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("arguments", [("--help",), ("list",), ("run", "copy"), ("nao", "check")])
def test_ctrl_c_while_importing_is_no_traceback(tmp_path, arguments):
    """The program is interrupted at each tenth module that it imports, one after the other."""
    code = (
        "import os, signal, sys\n"
        "class Finder:\n"
        "    left = int(sys.argv.pop(1))\n"
        "    def find_spec(self, name, path, target=None):\n"
        "        Finder.left -= 1\n"
        "        if Finder.left == 0: os.kill(os.getpid(), signal.SIGINT)\n"
        "from colift.cli.main import main\n"
        "sys.meta_path.insert(0, Finder())\n"
        "main()\n"
    )
    for place in (1, 5, 40, 80, 160):
        done = subprocess.run(
            [sys.executable, "-c", code, str(place), *arguments],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=120,
        )
        if done.returncode == 0:
            break  # It imported less.
        assert (done.returncode, done.stdout) == (130, "")
        assert "Traceback" not in done.stderr
    assert place > 5
