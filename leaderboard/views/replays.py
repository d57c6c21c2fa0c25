"""The pages of replays: some lifts of a policy, and each in a file of its own."""

import contextlib
from typing import Any, Final

from colift.base.errors import InputError
from colift.leaderboard.replays.chosen import has_replays, replays_of
from colift.leaderboard.replays.html import KEYS, SCRIPTS, replay_data, replay_files, replay_page
from colift.leaderboard.views.page import Content, NoPageError, Page, Visit, find_season


def replays_in(visit: Visit, season: str, digest: str) -> list[dict[str, Any]]:
    """Return the replays of a submission; none if this colift no longer plays its suite."""
    entry = visit.board.entry(season, digest)
    bundle = visit.board.bundle(season, digest)
    with contextlib.suppress(InputError):
        return [] if entry is None or bundle is None else replays_of(bundle, entry.name)
    return []


def watchable(visit: Visit, season: str, digest: str) -> bool:
    """Return whether a submission has replays; a service does not wait until they are made."""
    if visit.queue is None:
        return bool(replays_in(visit, season, digest))
    bundle = visit.board.bundle(season, digest)
    return bundle is not None and has_replays(bundle)


def _replays(visit: Visit, season: str, digest: str) -> Content:
    info, entry = find_season(visit.board, season), visit.board.entry(season, digest)
    found = replays_in(visit, season, digest)
    if entry is None or not found:
        raise NoPageError("There are no replays of this submission.")
    if visit.queue is None:
        return replay_page(found)
    return {
        "season": info,
        "digest": digest,
        "name": entry.name,
        "replays": replay_data(found),
        "files": replay_files(found),
        "scripts": SCRIPTS,
        "keys": KEYS,
    }


def _replay(visit: Visit, season: str, digest: str, name: str) -> Content:
    found = replay_files(replays_in(visit, season, digest))
    if name not in found:
        raise NoPageError("There is no such replay.")
    return replay_page([found[name]])


PAGES: Final = (
    Page(
        name="replays",
        url="/seasons/{season}/policies/{digest}/replays",
        file="replays-{season}-{digest:.16}.html",
        view=_replays,
        template="replays.html",
        meaning="Some lifts of a submission, to watch.",
    ),
    Page(
        name="replay",
        url="/seasons/{season}/policies/{digest}/replays/{name}.html",
        file="replay-{season}-{digest:.16}-{name}.html",
        view=_replay,
        headers={"Content-Disposition": 'attachment; filename="{digest:.16}-{name}.html"'},
        meaning="One lift, as a file that needs no others.",
    ),
)
