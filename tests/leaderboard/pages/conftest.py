"""A board of real rows, its service, its site, and a browser that looks at them."""

import dataclasses
import pickle
import re
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import timedelta
from pathlib import Path

import pytest
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.decisions import Decisions
from colift.leaderboard.core.seasons import ImportedSeason
from colift.leaderboard.evaluation.evaluate import play_season_references
from colift.leaderboard.pages.site import write_site
from colift.leaderboard.records.season import Season
from colift.leaderboard.service.app import create_app
from colift.leaderboard.service.documentation import Documentation
from playwright.sync_api import Browser, Page, ViewportSize

from ...serving import serving
from .boards import BEGAN, SECRET, digest, practice, renamed


@contextmanager
def running(folder: Path, docs: Documentation | None = None) -> Iterator[str]:
    """Serve a board from a thread of this process; yield its URL."""
    with serving(create_app(folder, docs=docs)) as url:
        yield url


@pytest.fixture(scope="session")
def played(once: Callable[..., Path]) -> ImportedSeason:
    def make(place: Path) -> None:
        hidden = Season(name="2026", suite=make_suite("quick-v1"), secret=SECRET)
        rows = practice(place, hidden.name)
        whole = dataclasses.replace(rows, references=play_season_references(hidden))
        (place / "season").write_bytes(pickle.dumps(whole))

    season: ImportedSeason = pickle.loads((once("played", make) / "season").read_bytes())
    return season


@pytest.fixture(scope="session")
def kept(played: ImportedSeason, once: Callable[..., Path]) -> Path:
    """A board with a frozen and a current season, a withdrawal and a rescore; and its site."""

    def make(place: Path) -> None:
        board = Board.open(place / "board", "quick-v1")
        board.import_season(renamed(played, "2025", BEGAN - timedelta(days=300)))
        board.import_season(played)
        Decisions(board).withdraw("2025", digest("hold"), "Ada", "it <i>never</i> moved")
        write_site(board, place / "site")
        board.close()

    return once("pages", make)


@pytest.fixture(scope="session")
def folder(kept: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """That board, for the tests of this process alone."""
    place = tmp_path_factory.mktemp("pages") / "board"
    return shutil.copytree(kept / "board", place)


@pytest.fixture(scope="session")
def url(folder: Path) -> Iterator[str]:
    with running(folder) as address:
        yield address


@pytest.fixture(scope="session")
def site(kept: Path) -> str:
    """The address of the pages as files."""
    return (kept / "site").as_uri()


DESKTOP = ViewportSize(width=1280, height=900)


@contextmanager
def opened_page(browser: Browser) -> Iterator[tuple[Page, list[str]]]:
    """Open a page; yield it, and what goes wrong: errors of its scripts, and other hosts."""
    wrong: list[str] = []
    context = browser.new_context(viewport=DESKTOP)
    opened = context.new_page()
    opened.set_default_timeout(60_000)  # A machine may be busy; no test is about time.
    opened.on("pageerror", lambda error: wrong.append(str(error)))
    opened.on("console", lambda told: wrong.append(told.text) if _bad(told) else None)
    opened.on("request", lambda asked: wrong.append(asked.url) if _abroad(asked.url) else None)
    yield opened, wrong
    context.close()


@pytest.fixture(scope="module")
def shared_page(chromium: Browser) -> Iterator[tuple[Page, list[str]]]:
    with opened_page(chromium) as shared:
        yield shared


@pytest.fixture
def page(shared_page: tuple[Page, list[str]]) -> Iterator[Page]:
    """A page that fails the test by an error of its scripts, or a request to another host.

    The tests of a module load what they look at into the same one: a browser takes three times as
    long to open a page as to load one. What a page stores is not removed.
    """
    opened, wrong = shared_page
    wrong.clear()
    yield opened
    opened.goto("about:blank")
    opened.set_viewport_size(DESKTOP)
    opened.emulate_media(color_scheme="null", reduced_motion="null")
    assert wrong == []


@pytest.fixture
def own_page(chromium: Browser) -> Iterator[Page]:
    """The same, without anything that another test's page has stored."""
    with opened_page(chromium) as (opened, wrong):
        yield opened
    assert wrong == []


def _bad(told) -> bool:
    # That an upload was refused is shown on the page; the browser writes it down, too.
    return told.type == "error" and "the server responded with a status of 4" not in told.text


def _abroad(url: str) -> bool:
    return re.match(r"(http://127\.0\.0\.1:\d+/|file:|data:|about:|blob:)", url) is None


@pytest.fixture(params=["service", "files"])
def front(request: pytest.FixtureRequest) -> str:
    """The address of the board's page: of the service, and as a file."""
    if request.param == "service":
        return str(request.getfixturevalue("url")) + "/"
    return str(request.getfixturevalue("site")) + "/index.html"


@pytest.fixture
def names() -> Callable[[Page], list[str]]:
    """Return what reads the policies of the table that are shown, from the top."""
    return lambda page: page.locator("table.board tbody tr:visible th a").all_text_contents()
