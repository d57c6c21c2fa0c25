"""A service on loopback, spoken to over HTTP."""

import io
import re
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest
from colift.agents.submissions.new import write_template
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.service.app import create_app
from colift.leaderboard.service.dependencies import Rates
from colift.leaderboard.service.security import Rate
from colift.leaderboard.storage.archive import pack_archive

from ...serving import serving as served
from .uploaded import left_over

UNLIMITED = Rates(
    address=Rate(per_second=1e6, burst=10**6), submitter=Rate(per_second=1e6, burst=10**6)
)


@contextmanager
def running(
    folder: Path, rates: Rates | None = None, root: str = "", **options: str
) -> Iterator[str]:
    """Serve a board from a thread of this process; yield its URL."""
    with served(create_app(folder, rates, **options), root) as url:
        yield url


@contextmanager
def opened(folder: Path) -> Iterator[Board]:
    """Yield a board; a new one is of quick-v1."""
    board = Board.open(folder, None if folder.exists() else "quick-v1")
    try:
        yield board
    finally:
        board.close()


@pytest.fixture(scope="session")
def serving():
    """Return :func:`running`."""
    return running


@pytest.fixture(scope="session")
def opening():
    """Return :func:`opened`."""
    return opened


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A board of quick-v1."""
    place = tmp_path_factory.mktemp("service") / "board"
    with opened(place):
        return place


@pytest.fixture(scope="module")
def add_token(folder: Path) -> Callable[[str], str]:
    """Return what makes a token of the board."""

    def add(name: str) -> str:
        with opened(folder) as board:
            return Tokens(board).add(name)

    return add


@pytest.fixture(scope="module")
def url(folder: Path) -> Iterator[str]:
    """The service of that board, for one who may ask as often as he likes."""
    with running(folder, UNLIMITED) as address:
        yield address


@pytest.fixture(scope="module")
def client(url: str) -> Iterator[httpx.Client]:
    with httpx.Client(base_url=url, timeout=60) as made:
        yield made


@pytest.fixture(scope="module")
def ada(add_token: Callable[[str], str]) -> dict[str, str]:
    """Headers of somebody who may submit."""
    return {"Authorization": f"Bearer {add_token('ada')}", "Content-Type": "application/zip"}


@pytest.fixture(scope="session")
def zipped(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., bytes]:
    """Return what packs the template under a name, with texts in its files exchanged."""

    def make(name: str = "mine", policy: str = "", manifest: tuple[str, str] = ("", "")) -> bytes:
        folder = tmp_path_factory.mktemp("zipped") / "submission"
        write_template(folder)
        told = (folder / "policy.toml").read_text()
        told = re.sub('name = ".*"', lambda match: f'name = "{name}"', told)
        told = told.replace(*manifest) if manifest[0] else told
        (folder / "policy.toml").write_text(told.replace("Your Name", "Ada Lovelace"))
        if policy:
            (folder / "policy.py").write_text(policy)
        file = io.BytesIO()
        pack_archive(folder, file)
        return file.getvalue()

    return make


@pytest.fixture
def nothing_is_left(folder):
    yield
    deadline = time.monotonic() + 20  # The service may still be told that a client has gone.
    while left_over(folder) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert left_over(folder) == []
