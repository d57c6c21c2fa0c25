"""The pages as files, for a disk or any host of static files."""

import contextlib
import shutil
import tempfile
from collections.abc import Iterator
from importlib.resources import as_file, files
from pathlib import Path
from typing import Any, Final

from colift.agents.errors import InputError
from colift.leaderboard.board.board import Board
from colift.leaderboard.pages.formats import badge_text
from colift.leaderboard.pages.links import SiteLinks
from colift.leaderboard.pages.rendering import prose, render_page, template_archive
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.replays.chosen import replays_of
from colift.leaderboard.replays.html import replay_files, replay_page, script_json
from colift.leaderboard.storage.archive import pack_archive
from colift.leaderboard.views.asked import ROWS, Asked
from colift.leaderboard.views.board import board_view, ordered_seasons
from colift.leaderboard.views.compare import compare_view
from colift.leaderboard.views.exports import news_of, standings_csv, standings_json
from colift.leaderboard.views.lifts import is_whole
from colift.leaderboard.views.method import method_view
from colift.leaderboard.views.policy import PolicyView, policy_view
from colift.leaderboard.views.scenario import scenario_view, scenarios_view

MARK: Final = "colift-site.txt"
"""Name of the file that marks a folder as a site, which another one may replace."""

Page = tuple[str, str]
"""Name and content of a file."""


def write_site(board: Board, folder: Path) -> None:
    """Write the pages of a board into a folder; replace an older site there.

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
            _write(board, made)
            if folder.exists():
                folder.rename(Path(temporary) / "older")
            made.rename(folder)
    except OSError as error:
        raise InputError(f"cannot write {folder}: {error.strerror}") from error


def _write(board: Board, folder: Path) -> None:
    (folder / "data").mkdir(parents=True)
    (folder / MARK).write_text("The pages of a colift board.\n", encoding="utf-8")
    with as_file(files("colift.leaderboard") / "static") as static:
        shutil.copytree(static, folder / "static")
    seasons = ordered_seasons(board)
    links = SiteLinks(seasons[0].name)
    for info in seasons:
        for name, content in _season(board, info, links):
            (folder / name).write_text(content, encoding="utf-8")
        _write_bundles(board, info, links, folder)
    (folder / links.template()).write_bytes(template_archive())
    view = method_view(board)
    for name, content in (
        (links.method(), render_page("method.html", links, view=view)),
        (links.open(), render_page("open.html", links, season=view.season, text=prose("open.md"))),
        (links.submit(), render_page("submit.html", links, season=view.season, lifts=view.lifts)),
    ):
        (folder / name).write_text(content, encoding="utf-8")


def _season(board: Board, info: SeasonInfo, links: SiteLinks) -> Iterator[Page]:
    """Yield the pages and the data of a season."""
    season = info.name
    rows = board.standings(season)  # With its own ranks, for all pages.
    yield from _boards(board, info, links)
    yield links.csv(season), standings_csv(board, season)
    yield links.json(season), standings_json(board, season)
    news = news_of(board, season)
    yield links.feed(season), render_page("feed.xml", links, news=news, prefix="../")
    yield (
        links.compare(season),
        render_page("compare.html", links, view=compare_view(board, season), asked=None),
    )
    yield from _scenarios(board, info, links)
    for each in rows:
        digest = each.row.submission
        bundle = board.bundle(season, digest)
        found = [] if bundle is None else _replays(bundle, each.row.name)
        view = policy_view(board, season, digest)
        if isinstance(view, PolicyView):
            page = render_page("policy.html", links, view=view, has_replays=bool(found))
            yield links.policy(season, digest), page
            yield (
                links.badge(season, digest),
                render_page("badge.svg", links, text=badge_text(each)),
            )
        if found:
            yield links.replays(season, digest), replay_page(found)
        for name, replay in replay_files(found).items():
            yield links.replay(season, digest, name), replay_page([replay])


def _boards(board: Board, info: SeasonInfo, links: SiteLinks) -> Iterator[Page]:
    """Yield the pages of a table, and the script with the rows behind the first page."""
    total = len(board.tables.read(info.name).ranking)
    for number, first in enumerate(range(0, max(total, 1), ROWS), 1):
        view = board_view(board, info.name, Asked(first=first))
        yield links.rows(info.name, number), render_page("board.html", links, view=view)
    rest = board_view(board, info.name, Asked(first=ROWS), most=total)
    if total > ROWS and rest is not None:
        content = {
            "html": render_page("rows.html", links, view=rest),
            "rows": rest.data["rows"],
        }
        yield links.rest(info.name), f"window.coliftRows = {script_json(content)};\n"


def _replays(bundle: Path, policy: str) -> list[dict[str, Any]]:
    """Return the replays of a bundle, if this colift still plays its suite."""
    with contextlib.suppress(InputError):
        return replays_of(bundle, policy)
    return []


def _scenarios(board: Board, info: SeasonInfo, links: SiteLinks) -> Iterator[Page]:
    view = scenarios_view(board, info.name)
    if view is None:
        message = f"This colift does not play the suite of season {info.name}."
        yield (
            links.scenarios(info.name),
            render_page("missing.html", links, season=info, message=message),
        )
        return
    yield links.scenarios(info.name), render_page("scenarios.html", links, view=view)
    for behaviour, subject in view.strata:
        name = links.scenario(info.name, behaviour, subject)
        one = scenario_view(board, info.name, behaviour, subject)
        yield name, render_page("scenario.html", links, view=one)


def _write_bundles(board: Board, info: SeasonInfo, links: SiteLinks, folder: Path) -> None:
    for each in board.standings(info.name):
        digest = each.row.submission
        bundle = board.bundle(info.name, digest)
        if bundle is not None and is_whole(bundle):
            with (folder / links.bundle(info.name, digest)).open("w+b") as file:
                pack_archive(bundle, file)
