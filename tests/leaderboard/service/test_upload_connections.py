"""Uploads over bad connections: too large, without end, cut off, silent, slow, killed."""

import select
import socket
import time

import pytest
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.queue import Queue
from colift.leaderboard.service import uploads
from colift.leaderboard.service.uploads import BODY
from colift.leaderboard.storage.staging import PREFIX

from ... import web
from .uploaded import MANY, SUBMIT, left_over

pytestmark = pytest.mark.usefixtures("nothing_is_left")


def answered(connection):
    """Return an answer up to the end of its object, or to the end of the connection."""
    answer = b""
    while b"}" not in answer and (more := connection.recv(65536)):
        answer += more
    return answer


def test_a_body_that_says_it_is_too_large_is_refused_unread(url, ada):
    """As curl sends it: it waits for the permission to go on."""
    host, port = url.removeprefix("http://").split(":")
    head = "".join(f"{name}: {value}\r\n" for name, value in ada.items())
    with socket.create_connection((host, int(port)), timeout=20) as connection:
        connection.sendall(
            f"POST {SUBMIT} HTTP/1.1\r\nHost: x\r\n{head}Content-Length: {MANY}\r\n"
            "Expect: 100-continue\r\n\r\n".encode()
        )
        answer = answered(connection)
    assert answer.startswith(b"HTTP/1.1 413 ")
    assert b"a zip archive may have at most 64 MiB" in answer


def test_a_body_without_end_is_refused_early_and_not_kept(url, folder, ada):
    """A gigabyte in chunks, without a length, by a client that listens while it sends."""
    host, port = url.removeprefix("http://").split(":")
    head = "".join(f"{name}: {value}\r\n" for name, value in ada.items())
    chunk = b"100000\r\n" + bytes(2**20) + b"\r\n"
    sent, most = 0, 0
    with socket.create_connection((host, int(port)), timeout=20) as connection:
        connection.sendall(
            f"POST {SUBMIT} HTTP/1.1\r\nHost: x\r\n{head}"
            "Transfer-Encoding: chunked\r\n\r\n".encode()
        )
        while sent < MANY and not select.select([connection], [], [], 0)[0]:
            connection.sendall(chunk)
            sent += 2**20
            used = [path.stat().st_size for path in folder.glob(f"submissions/{PREFIX}*/*")]
            most = max(most, *used, 0)
        answer = answered(connection)
    assert answer.startswith(b"HTTP/1.1 413 ")
    assert answer.endswith(b'{"error":"a zip archive may have at most 64 MiB"}')
    assert BODY < sent < 2 * BODY
    assert 0 < most <= BODY


def test_who_does_not_listen_while_sending_gets_the_answer_as_well(client, ada):
    def large():
        for _ in range(BODY // 2**20 + 40):
            yield bytes(2**20)

    answer = client.post(SUBMIT, headers=ada, content=large())
    assert answer.status_code == 413
    assert answer.json() == {"error": "a zip archive may have at most 64 MiB"}


def test_a_client_that_goes_away_leaves_nothing(client, url, folder, ada, zipped):
    host, port = url.removeprefix("http://").split(":")
    head = "".join(f"{name}: {value}\r\n" for name, value in ada.items())
    with socket.create_connection((host, int(port))) as connection:
        connection.sendall(
            f"POST {SUBMIT} HTTP/1.1\r\nHost: x\r\n{head}Content-Length: 9999\r\n\r\nPK".encode()
        )
        while not left_over(folder):
            time.sleep(0.01)
    while left_over(folder):
        time.sleep(0.01)


def test_a_client_that_falls_silent_is_told_so(client, folder, ada, monkeypatch):
    monkeypatch.setattr(uploads, "WINDOW_S", 0.2)

    def silent():
        yield b"PK"
        time.sleep(1)
        yield b""

    answer = client.post(SUBMIT, headers=ada, content=silent())
    assert answer.status_code == 408
    assert "too slow" in answer.json()["error"]


def test_a_refused_upload_leaves_nothing_and_the_same_content_is_still_its_job(
    client, folder, add_token, zipped
):
    headers = {"Authorization": f"Bearer {add_token('full')}", "Content-Type": "application/zip"}
    jobs = [client.post(SUBMIT, headers=headers, content=zipped(f"full{i}")) for i in range(5)]
    before = sorted(folder.rglob("*"))
    for number in (5, 6):
        answer = client.post(SUBMIT, headers=headers, content=zipped(f"full{number}"))
        assert answer.status_code == 429
    assert sorted(folder.rglob("*")) == before
    again = client.post(SUBMIT, headers=headers, content=zipped("full0"))
    assert (again.status_code, again.json()["id"]) == (202, jobs[0].json()["id"])


def sent(url, headers, length):
    """Return a connection that has begun an upload of that length."""
    host, port = url.removeprefix("http://").split(":")
    head = "".join(f"{name}: {value}\r\n" for name, value in headers.items())
    connection = socket.create_connection((host, int(port)), timeout=60)
    connection.sendall(
        f"POST {SUBMIT} HTTP/1.1\r\nHost: x\r\n{head}Content-Length: {length}\r\n\r\n".encode()
    )
    return connection


def test_an_upload_that_was_begun_before_its_token_was_revoked_is_refused(
    url, folder, opening, add_token, zipped
):
    headers = {"Authorization": f"Bearer {add_token('mallory')}"}
    headers["Content-Type"] = "application/zip"
    body = zipped("mallory")
    with sent(url, headers, len(body)) as connection:
        connection.sendall(body[:100])
        while not left_over(folder):
            time.sleep(0.01)
        with opening(folder) as board:
            Tokens(board).revoke("mallory")
            connection.sendall(body[100:])
            answer = connection.recv(65536)
            assert answer.startswith(b"HTTP/1.1 401 ")
            assert not any(job.submitter == "mallory" for job in Queue(board).jobs())


def test_slow_uploads_of_one_delay_nobody_else_and_end(
    url, folder, ada, add_token, zipped, monkeypatch
):
    monkeypatch.setattr(uploads, "WINDOW_S", 100.0)
    slow = {"Authorization": f"Bearer {add_token('slow')}", "Content-Type": "application/zip"}
    connections = [sent(url, slow, 10**6) for _ in range(8)]
    try:
        while len(left_over(folder)) < 2:
            time.sleep(0.01)
        answer = web.post(f"{url}{SUBMIT}", headers=ada, content=zipped("quick"))
        assert answer.status_code == 202
        assert len(left_over(folder)) == 2
        monkeypatch.setattr(uploads, "WINDOW_S", 0.5)
        ended, deadline = [], time.monotonic() + 50
        while not ended:  # A byte now and then is not enough.
            assert time.monotonic() < deadline
            for connection in connections:
                connection.sendall(b"P")
            ended = select.select(connections, [], [], 0.2)[0]
        assert b" 408 " in ended[0].recv(65536)
    finally:
        for connection in connections:
            connection.close()
    while left_over(folder):
        time.sleep(0.01)


def test_what_killed_uploads_have_left_is_removed_at_the_next_start(
    folder, serving, ada, opening, zipped
):
    """Also their folder of a moment ago; not that of another service that is at work."""
    left = folder / "submissions" / f"{PREFIX}killed"
    left.mkdir()
    (left / "lock").touch()
    (left / "upload.zip").write_bytes(b"PK")
    with opening(folder) as board, board.store.staging() as working, serving(folder):
        assert left_over(folder) == [working]
