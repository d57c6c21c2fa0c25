"""A season on a few lifts, entrants, submissions in folders, and boards on two databases."""

import itertools
from collections.abc import Callable, Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path

import psycopg
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.submissions.manifest import Manifest
from colift.agents.submissions.new import write_template
from colift.base.registry import SUITES, entries
from colift.benchmark.results.scores import ScoreTable
from colift.leaderboard.core.board import Board
from colift.leaderboard.database.connection import Database
from colift.leaderboard.evaluation.entrant import Entrant
from colift.leaderboard.evaluation.evaluate import play_human_human
from colift.leaderboard.records.season import Season

from .postgresql import server
from .tiny import ENTRY, tiny

SECRET = bytes(range(32))
WriteSubmission = Callable[..., Path]
OpenBoard = Callable[..., Board]
schemas = itertools.count()


class Clock:
    """A clock that a test turns."""

    def __init__(self) -> None:
        self.now = datetime(2027, 3, 1, 12, tzinfo=UTC)

    def __call__(self) -> datetime:
        return self.now

    def turn(self, **more: float) -> None:
        self.now += timedelta(**more)


@pytest.fixture(scope="module")
def tiny_suite() -> Iterator[None]:
    """A suite ``tiny`` of two lifts, so that an evaluation takes seconds."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setitem(entries(SUITES), "tiny", ENTRY)
        yield


def make_season(secret: bytes = SECRET) -> Season:
    """Return a season of two lifts."""
    return Season(name="test", suite=tiny(), secret=secret)


def make_entrant(policy, fresh=None) -> Entrant:
    return Entrant(
        manifest=Manifest(
            name="mine",
            authors=("Ada", "Grace"),
            description="Lifts.",
            licence="MIT",
            trained_on="nothing",
        ),
        digest="d" * 64,
        policy=policy,
        fresh=fresh or policy,
    )


@pytest.fixture(scope="session")
def season() -> Season:
    return make_season()


@pytest.fixture(scope="session")
def human_human(season: Season) -> ScoreTable:
    return play_human_human(season)


@pytest.fixture
def copy() -> Entrant:
    return make_entrant(PolicySpec(text="copy"))


@pytest.fixture
def write_submission(tmp_path: Path) -> WriteSubmission:
    """Return what writes the template into a folder, with another policy if one is given."""

    def write(code: str = "", name: str = "mine", manifest: tuple[str, str] = ("", "")) -> Path:
        folder = tmp_path / name
        write_template(folder)
        if code:
            (folder / "policy.py").write_text(code)
        told = folder / "policy.toml"
        text = told.read_text().replace(*manifest) if manifest[0] else told.read_text()
        told.write_text(text.replace("Your Name", "Ada Lovelace"))
        return folder

    return write


@pytest.fixture(scope="session")
def postgresql() -> Iterator[str]:
    """Start a PostgreSQL server, and return its URL."""
    with server() as url:
        yield url


@pytest.fixture(params=["sqlite", "postgresql"])
def database(request: pytest.FixtureRequest) -> str | None:
    """Return the URL of an empty database; None is the file in a board's folder."""
    return None if request.param == "sqlite" else new_schema(request.getfixturevalue("postgresql"))


def new_schema(url: str) -> str:
    """Return the URL of a new schema on a server: as good as a new database, and quicker."""
    name = f"test{next(schemas)}"
    with psycopg.connect(url) as connection:
        connection.execute(f"CREATE SCHEMA {name}")
    return f"{url}&options=-csearch_path%3D{name}"


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def open_board(
    tmp_path: Path, database: str | None, clock: Clock, monkeypatch: pytest.MonkeyPatch
) -> Iterator[OpenBoard]:
    """Return what opens the board of this test, on either database; the test turns their clock."""
    monkeypatch.setattr(Database, "now", lambda *_: clock.now)
    opened = []

    def make(name: str = "board", suite: str | None = None) -> Board:
        board = Board.open(tmp_path / name, suite, url=database, clock=clock)
        opened.append(board)
        return board

    yield make
    for board in opened:
        board.close()


@pytest.fixture
def board(open_board: OpenBoard) -> Board:
    return open_board(suite="quick-v1")
