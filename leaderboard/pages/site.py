"""The pages as files, for a disk or any host of static files."""

import shutil
import tempfile
from collections.abc import Collection, Iterator, Mapping, Sequence
from importlib.resources import as_file, files
from pathlib import Path
from typing import Final

from colift.base.errors import InputError
from colift.leaderboard.core.board import Board
from colift.leaderboard.pages.links import STATIC, Links
from colift.leaderboard.pages.rendering import render_page, show
from colift.leaderboard.pages.table import PAGES
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.replays.html import replay_files
from colift.leaderboard.storage.archive import pack_archive
from colift.leaderboard.views.asked import ROWS
from colift.leaderboard.views.lifts import is_whole
from colift.leaderboard.views.page import (
    NAME,
    NoPageError,
    Page,
    Visit,
    find_season,
    ordered_seasons,
)
from colift.leaderboard.views.replays import replays_in
from colift.leaderboard.views.suites import season_suite

MARK: Final = "colift-site.txt"
"""Name of the file that marks a folder as a site, which another one may replace."""


def write_site(board: Board, folder: Path, name: str = NAME) -> None:
    """Write the pages of a board into a folder under its name; replace an older site there.

    Readers of the folder see the older one until the new one is complete.

    Raises
    ------
    InputError
        If the folder has other content or cannot be written to, or a library is missing.
    """
    if folder.exists() and not (folder / MARK).is_file() and any(folder.iterdir()):
        raise InputError(f"{folder} has other content; name a new folder for the site")
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder.parent, prefix=".site-") as temporary:
            made = Path(temporary) / "site"
            _write(board, made, name)
            if folder.exists():
                folder.rename(Path(temporary) / "older")
            made.rename(folder)
    except OSError as error:
        raise InputError(f"cannot write {folder}: {error.strerror}") from error


def _write(board: Board, folder: Path, name: str) -> None:
    (folder / "data").mkdir(parents=True)
    (folder / MARK).write_text("The pages of a colift board.\n", encoding="utf-8")
    for package, inside in STATIC:
        with as_file(files(package) / inside) as static:
            shutil.copytree(static, folder / "static", dirs_exist_ok=True)
    seasons = ordered_seasons(board)
    links, visit = Links(current=seasons[0].name), Visit(board=board, name=name)
    for info in seasons:
        board.standings(info.name)  # With its own ranks, for all pages.
        _write_bundles(board, info, links, folder)
    for page in PAGES.values():
        if page.file and page.view is not None:
            for values in _values(visit, page, seasons):
                _write_page(page, links, visit, values, folder)


def _write_page(
    page: Page, links: Links, visit: Visit, values: Mapping[str, str], folder: Path
) -> None:
    """Write a page, if there is one; where the navigation leads, a page says why there is none."""
    try:
        content = show(page, links, visit, values)
    except NoPageError as error:
        if not page.menu:
            return
        season = find_season(visit.board, values.get("season"))
        told = {"season": season, "board_name": visit.name, "message": str(error)}
        content = render_page("missing.html", links, **told)
    raw = content.encode() if isinstance(content, str) else content
    (folder / links.to(page, *values.values())).write_bytes(raw)


def _values(visit: Visit, page: Page, seasons: Sequence[SeasonInfo]) -> Iterator[dict[str, str]]:
    """Yield the parts of the addresses of a page: each season, and each row of it, for example."""
    if not page.parts:
        yield {}
        return
    for info in seasons:
        if page.name == "season" and info.current:
            continue  # It is the front page.
        for others in _of_season(visit, info, page.parts):
            yield {"season": info.name, **others}


def _of_season(visit: Visit, info: SeasonInfo, parts: Collection[str]) -> Iterator[dict[str, str]]:
    """Yield the parts after the season."""
    if "digest" in parts:
        for row in visit.board.standings(info.name):
            digest = row.row.submission
            if "name" in parts:
                for name in replay_files(replays_in(visit, info.name, digest)):
                    yield {"digest": digest, "name": name}
            else:
                yield {"digest": digest}
    elif "behaviour" in parts:
        suite = season_suite(info)
        scenarios = () if suite is None else suite.scenarios
        for behaviour in dict.fromkeys(each.behaviour for each in scenarios):
            yield {"behaviour": behaviour}
    elif "number" in parts:
        total = len(visit.board.tables.read(info.name).ranking)
        for number in range(2, -(-total // ROWS) + 1):
            yield {"number": str(number)}
    else:
        yield {}


def _write_bundles(board: Board, info: SeasonInfo, links: Links, folder: Path) -> None:
    for each in board.standings(info.name):
        digest = each.row.submission
        bundle = board.bundle(info.name, digest)
        if bundle is not None and is_whole(bundle):
            with (folder / links.bundle(info.name, digest)).open("w+b") as file:
                pack_archive(bundle, file)
