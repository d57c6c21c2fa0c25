"""``colift serve`` as a user meets it: a process, an address, an end."""

import os
import re
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import httpx
import pytest
from colift.base.extras import how_to_install
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.tokens import Tokens

from .. import web
from ..play.web.pages import Page, new_session

pytestmark = pytest.mark.slow


def parent(process):
    """Return the id of a process's parent, and whether it is still there."""
    try:
        return int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])
    except (FileNotFoundError, ProcessLookupError):
        return None


def children(process):
    everybody = [int(path.name) for path in Path("/proc").glob("[0-9]*")]
    return [each for each in everybody if parent(each) == process]


def until(condition, seconds=60):
    """Wait for something that must come."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it has not come"
        time.sleep(0.05)


@pytest.fixture
def folder(tmp_path):
    Board.open(tmp_path / "board", "quick-v1").close()
    return tmp_path / "board"


@pytest.fixture
def serve(folder):
    """Return what starts the command and waits for what it says."""
    started = []

    def run(*arguments):
        process = subprocess.Popen(
            [sys.executable, "-m", "colift.cli", "serve", "--board", str(folder), *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        return process, process.stdout.readline()

    yield run
    for process in started:
        if process.poll() is None:
            process.terminate()
        process.communicate(timeout=60)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_it_tells_its_address_and_ends_with_its_workers(serve, folder, number):
    process, line = serve("--port", "0", "--workers", "2")
    url = re.search(r"http://127\.0\.0\.1:\d+", line)[0]
    assert str(folder) in line
    assert web.get(f"{url}/healthz").json() == {"status": "ok", "season": "1"}
    until(lambda: len(children(process.pid)) == 2)
    workers = children(process.pid)
    process.send_signal(number)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 0
    assert "Traceback" not in err
    assert [parent(worker) for worker in workers] == [None, None]
    with pytest.raises(httpx.ConnectError):
        web.get(url)


def test_it_ends_once_however_often_it_is_told_to(serve):
    process, _ = serve("--port", "0", "--workers", "1")
    until(lambda: children(process.pid))
    time.sleep(1)  # The worker is about to load.
    for number in (signal.SIGTERM, signal.SIGTERM, signal.SIGINT, signal.SIGTERM):
        process.send_signal(number)
        time.sleep(0.1)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 0
    assert "Traceback" not in err


def test_workers_are_started_again_and_do_not_outlive_a_service_that_is_killed(serve):
    process, _ = serve("--port", "0", "--workers", "1")
    until(lambda: children(process.pid))
    (first,) = children(process.pid)
    os.kill(first, signal.SIGKILL)
    until(lambda: children(process.pid) not in ([], [first]))
    (second,) = children(process.pid)
    process.kill()
    until(lambda: parent(second) is None)


def test_what_an_upload_has_left_when_the_service_is_killed_is_gone_after_the_next_start(
    serve, folder
):
    board = Board.open(folder)
    token = Tokens(board).add("ada")
    board.close()
    process, line = serve("--port", "0", "--workers", "0")
    host, port = re.search(r"http://(127\.0\.0\.1):(\d+)", line).groups()
    with socket.create_connection((host, int(port))) as connection:
        connection.sendall(
            f"POST /api/v1/submissions HTTP/1.1\r\nHost: x\r\nAuthorization: Bearer {token}\r\n"
            "Content-Type: application/zip\r\nContent-Length: 999\r\n\r\nPK".encode()
        )
        until(lambda: list((folder / "submissions").iterdir()))
        process.kill()
        process.wait()
    assert list((folder / "submissions").iterdir())
    serve("--port", "0", "--workers", "0")
    assert list((folder / "submissions").iterdir()) == []


def test_a_port_that_is_taken_is_named(colift, folder):
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        done = colift("serve", "--board", folder, "--port", port, "--workers", "0")
    assert (done.returncode, done.stdout) == (2, "")
    assert f"cannot listen on 127.0.0.1:{port}: port {port} is taken" in done.stderr
    assert "--port" in done.stderr


def test_an_address_that_is_not_here_is_named(colift, folder):
    done = colift("serve", "--board", folder, "--host", "192.0.2.1", "--workers", "0")
    assert done.returncode == 2
    assert done.stderr.startswith(
        "error: cannot listen on 192.0.2.1:8000: this machine has no such address"
    )
    assert len(done.stderr.splitlines()) == 1


def test_it_serves_a_folder_of_documentation_below_its_root(serve, tmp_path):
    (tmp_path / "index.html").write_text("<title>The manual</title>")
    options = ("--port", "0", "--workers", "0", "--root", "/lab", "--docs", str(tmp_path))
    _, line = serve(*options)
    url = re.search(r"http://127\.0\.0\.1:\d+", line)[0]
    assert '<a href="/lab/docs/">Documentation</a>' in web.get(f"{url}/").text
    assert "The manual" in web.get(f"{url}/docs/").text


def test_it_links_to_documentation_elsewhere(serve):
    _, line = serve("--port", "0", "--workers", "0", "--docs", "https://lab.example/manual")
    url = re.search(r"http://127\.0\.0\.1:\d+", line)[0]
    page = web.get(f"{url}/").text
    assert '<a href="https://lab.example/manual">Documentation</a>' in page
    assert web.get(f"{url}/docs/").status_code == 404


def test_documentation_that_is_not_there_is_named(colift, folder):
    done = colift("serve", "--board", folder, "--workers", "0", "--docs", "nowhere")
    assert done.returncode == 2
    assert "got 'nowhere'" in done.stderr


def test_without_its_libraries_it_says_how_to_get_them(folder):
    code = (
        "import sys; sys.modules['fastapi'] = None\n"
        f"sys.argv = ['colift', 'serve', '--board', {str(folder)!r}]\n"
        "from colift.cli.main import main; main()"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 2
    assert how_to_install("board") in done.stderr
    assert "Traceback" not in done.stderr


def test_visitors_lift_if_the_board_offers_rooms(serve, folder):
    _, line = serve("--port", "0", "--workers", "0", "--play", "1", "--root", "/lab")
    url = re.search(r"http://127\.0\.0\.1:\d+", line)[0]
    assert '<a href="/lab/play/">Try it</a>' in web.get(f"{url}/").text
    page = web.get(f"{url}/play/")
    assert page.headers["Cross-Origin-Embedder-Policy"] == "require-corp"
    assert page.headers["Content-Security-Policy"].startswith("default-src 'self'")
    assert 'class="brand" href="/lab/"' in page.text
    for place in re.findall(r'(?:src|href)="/lab(/play/\S+)"', page.text):
        assert web.get(f"{url}{place}").status_code == 200
    session = new_session(f"{url}/play")
    with Page(f"{url}/play", *session) as visitor:
        visitor.until("joined", "queued")  # As busy as this machine is.
    assert (folder / "live" / session[0] / "session.json").is_file()


def test_pages_have_the_title_of_a_course_and_so_have_links_to_them_elsewhere(serve):
    _, line = serve("--port", "0", "--workers", "0", "--play", "1", "--title", "HRI")
    url = re.search(r"http://127\.0\.0\.1:\d+", line)[0]
    text = web.get(f"{url}/").text
    for wanted in (
        "<title>Season 1 · HRI</title>",
        '<meta property="og:site_name" content="HRI">',
        '<meta property="og:title" content="Season 1 · HRI">',
    ):
        assert wanted in text
    assert "<title>Lift with a robot · HRI</title>" in web.get(f"{url}/play/").text
    missing = web.get(f"{url}/nowhere", headers={"Accept": "text/html"})
    assert missing.status_code == 404
    assert "· HRI</title>" in missing.text


def test_a_board_without_rooms_has_no_sockets(serve):
    _, line = serve("--port", "0", "--workers", "0")
    url = re.search(r"http://127\.0\.0\.1:\d+", line)[0]
    assert ">Try it</a>" not in web.get(f"{url}/").text
    upgrade = {"Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13"}
    assert web.get(f"{url}/play/socket", headers=upgrade).status_code == 404
