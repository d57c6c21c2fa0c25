"""``colift play`` as a user meets it: one command, an address, an end, and processes that die."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from colift.base.extras import how_to_install
from colift.benchmark.real_lifts.session_folder import EVENTS

from .. import web
from ..play.web.pages import GRIP, Page, new_session

pytestmark = pytest.mark.slow


def descendants(process):
    """Return the ids of all processes that a process has started, and they in turn."""
    found = {}
    for path in Path("/proc").glob("[0-9]*"):
        try:
            fields = (path / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if fields[0] != "Z":
            found.setdefault(int(fields[1]), []).append(int(path.name))
    return [each for child in found.get(process, []) for each in [child, *descendants(child)]]


def alive(process):
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def web_process(command):
    """Return the id of a command's web process."""
    lines = {each: Path(f"/proc/{each}/cmdline").read_text() for each in descendants(command)}
    (found,) = [each for each, line in lines.items() if "spawn_main" in line]
    return found


def until(condition, seconds=30):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it has not come"
        time.sleep(0.05)


@pytest.fixture
def play(tmp_path):
    """Return what starts the command and waits for its address."""
    started = []

    def run(*arguments):
        command = [sys.executable, "-m", "colift.cli", "play", *arguments]
        process = subprocess.Popen(
            [*command, "--no-browser", "--port", "0", "--out", str(tmp_path / "live")],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=tmp_path,
        )
        started.append(process)
        address = re.search(r"http://[0-9.]+:\d+", process.stdout.readline())
        return process, address and address[0]

    yield run
    for process in started:
        if process.poll() is None:
            process.terminate()
        process.communicate(timeout=60)


def rejoin(url, session):
    """Join as a page does whose connection was lost: again and again."""
    end = time.monotonic() + 60
    while True:
        try:
            page = Page(url, *session)
            page.until("joined")
            return page
        except (OSError, EOFError, TimeoutError):
            assert time.monotonic() < end
            time.sleep(0.2)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_it_ends_with_all_that_it_has_started(play, number):
    process, url = play("hold")
    with Page(url, *new_session(url)) as host:
        assert host.ready()["partner"] == "hold"
        others = descendants(process.pid)
        assert len(others) >= 3  # The web process, the server of forks, and the room.
        process.send_signal(number)
        _, err = process.communicate(timeout=60)
    assert process.returncode == 0
    assert "Traceback" not in err
    until(lambda: not any(map(alive, others)))


def test_people_go_on_when_the_web_process_is_killed(play, tmp_path):
    process, url = play("hold")
    session = new_session(url)
    with Page(url, *session) as host:
        host.ready()
        host.say("grip", **GRIP)
        host.until("start")
        web = web_process(process.pid)
        others = descendants(web)
        assert others
        os.kill(web, signal.SIGKILL)
        until(lambda: not any(map(alive, others)))
    with rejoin(url, session) as host:
        assert host.ready()["lift"] == 1
    kinds = re.findall(r'"event": "(\w+)"', (tmp_path / "live" / session[0] / EVENTS).read_text())
    assert kinds[:1] == ["join"]
    assert kinds.count("join") == 2


def test_all_ends_when_the_command_is_killed(play):
    process, url = play("hold")
    with Page(url, *new_session(url)) as host:
        host.ready()
        others = descendants(process.pid)
        process.kill()
        process.wait()
        until(lambda: not any(map(alive, others)))


def test_the_page_offers_all_policies_the_named_one_first(play, tmp_path):
    (tmp_path / "mine.py").write_text(
        "class Mine:\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation): return [0.0]\n"
    )
    _, url = play("mine.py:Mine", "--isolation", "none", "--root", "/lab")
    with Page(url, *new_session(url)) as host:
        state = host.ready()
        assert state["partner"] == "Mine"
        assert {"Mine", "anticipate", "blend", "copy", "person"} <= set(state["partners"])
    assert 'href="/lab/' in web.get(url).text


def test_other_machines_are_told_what_they_lack(play):
    process, _ = play("hold", "--host", "0.0.0.0")
    process.terminate()
    _, err = process.communicate(timeout=60)
    assert process.returncode == 0
    assert "HTTPS" in err


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["nonesuch"], "unknown policy 'nonesuch'"),
        (["hold", "--isolation", "strong"], "unknown isolation 'strong'"),
        (["hold", "--rooms", "0"], "--rooms"),
        (
            ["ball_game,gain=1"],
            "policy 'ball_game,gain=1' is for the task 'ball': people lift with policies for the "
            "task 'level'",
        ),
        (["hold", "--out", "/dev/null"], "--out: /dev/null cannot be a folder"),
        (["hold", "--host", "192.0.2.1"], "cannot listen on 192.0.2.1"),
    ],
)
def test_wrong_usage_is_one_clear_line(colift, arguments, told):
    done = colift("play", "--no-browser", *arguments)
    assert done.returncode == 2
    assert told in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("needs", "told"),
    [
        (10, "policy 'Mine' is for the task 'ball', not for 'level', where it fails at once: step"),
        (99, "policy 'Mine' cannot be a partner: step 0: ValueError: got 5"),
    ],
)
def test_a_policy_that_nobody_could_lift_with_is_refused_at_the_start(
    colift, tmp_path, needs, told
):
    (tmp_path / "mine.py").write_text(
        "class Mine:\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation):\n"
        f"        if len(observation) != {needs}: raise ValueError(f'got {{len(observation)}}')\n"
        "        return [0.0]\n"
    )
    done = colift("play", "mine.py:Mine", "--no-browser", "--port", "0")
    assert done.returncode == 2
    assert told in done.stderr
    assert done.stdout == ""


def test_without_its_libraries_it_says_how_to_get_them(tmp_path):
    code = (
        "import sys; sys.modules['websockets'] = None\n"
        "sys.argv = ['colift', 'play', '--no-browser']\n"
        "from colift.cli.main import main; main()"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=60, cwd=tmp_path
    )
    assert done.returncode == 2
    assert how_to_install("board") in done.stderr
    assert "Traceback" not in done.stderr
    assert list(tmp_path.iterdir()) == []
