"""Bundles over HTTP: packed once, sent in parts or not again, and not to too many at once."""

import io
import shutil
import socket
import zipfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from colift.leaderboard.service import dependencies as state
from colift.leaderboard.service import published
from colift.leaderboard.storage import store
from colift.leaderboard.storage.store import Store

from ... import web
from ..rows import add, digest

SIZE = 8 * 2**20
NOISE = bytes(range(256)) * 64


@pytest.fixture
def place(folder, opening, request):
    """A row with a bundle of some size; return where its archive is."""
    name = f"b{abs(hash(request.node.name)) % 10**8}"
    with opening(folder) as board:
        add(board, name, 10.0)
        bundle = board.store.bundle("1", digest(name))
    bundle.mkdir(parents=True)
    with zipfile.ZipFile(bundle / "traces.npz", "w") as archive:  # As those of runs: not to pack.
        archive.writestr("x.npy", NOISE * (SIZE // len(NOISE)))
    return f"/api/v1/entries/1/{digest(name)}/bundle.zip"


def files(folder):
    return sorted(path for path in folder.rglob("*") if path.is_file())


def test_a_bundle_is_packed_once_however_many_ask(client, folder, place, monkeypatch):
    packed = []
    monkeypatch.setattr(
        store,
        "pack_archive",
        lambda *a, pack=store.pack_archive: (packed.append(a), pack(*a)),
    )
    with ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(client.get, [place] * 8))
    assert {answer.status_code for answer in answers} == {200}
    assert len({answer.content for answer in answers}) == 1
    assert len(packed) == 1
    first = answers[0]
    assert int(first.headers["Content-Length"]) == len(first.content)
    with zipfile.ZipFile(io.BytesIO(first.content)) as archive:
        assert archive.namelist() == ["traces.npz"]
    kept = folder / "public/1/entries" / place.split("/")[-2] / "bundle.zip"
    assert kept.read_bytes() == first.content
    kept.unlink()
    assert client.get(place).content == first.content  # The same bytes, whenever it is made.


def test_what_a_client_has_is_not_sent_again_and_parts_are(client, place):
    first = client.get(place)
    again = client.get(place, headers={"If-None-Match": first.headers["ETag"]})
    assert (again.status_code, again.content) == (304, b"")
    assert again.headers["ETag"] == first.headers["ETag"]
    assert client.get(place, headers={"If-None-Match": '"other"'}).status_code == 200
    part = client.get(place, headers={"Range": "bytes=100-199"})
    assert (part.status_code, part.content) == (206, first.content[100:200])


def test_a_lost_bundle_is_told_of(client, folder, place):
    name = place.split("/")[-2]
    shutil.rmtree(folder / "public/1/entries" / name)
    answer = client.get(place)
    assert answer.status_code == 404
    assert "the board has lost it; it can come back from a backup" in answer.json()["error"]


def unread(url, path):
    """Return a connection that has asked for something, and reads nothing of it."""
    host, port = url.removeprefix("http://").split(":")
    connection = socket.socket()
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    connection.connect((host, int(port)))
    connection.sendall(f"GET {path} HTTP/1.1\r\nHost: x\r\n\r\n".encode())
    return connection


def temporary(process="self"):
    """Return the open files of this process, which is also the service, that have no name."""
    links = []
    for link in Path(f"/proc/{process}/fd").iterdir():
        try:
            links.append(str(link.readlink()))
        except FileNotFoundError:
            continue
    return [link for link in links if link.endswith("(deleted)") and "/memfd" not in link]


@pytest.mark.slow
def test_clients_that_do_not_read_take_no_files_and_few_places(folder, serving, place, monkeypatch):
    (path := Store(folder).packed_bundle("1", place.split("/")[-2]))
    assert path.stat().st_size > 10_000
    with path.open("ab") as file:  # More than what sockets take without being read.
        file.truncate(64 * 2**20)
    monkeypatch.setattr(state, "PATIENCE_S", 0.2)
    monkeypatch.setattr(published, "SENDING_S", 10.0)
    with serving(folder) as url:
        before = temporary()
        connections = [unread(url, place) for _ in range(20)]
        try:
            while web.get(url + place, headers={"Range": "bytes=0-9"}).status_code != 429:
                pass
            assert temporary() == before
            # Before any of them is broken off.
            assert web.get(f"{url}/healthz", timeout=8).status_code == 200
            # The four are broken off in the end, and another one gets it.
            while web.get(url + place, headers={"Range": "bytes=0-9"}).status_code != 206:
                pass
        finally:
            for connection in connections:
                connection.close()
