"""The replay beside the headline of a table: a typical lift of its first policy, and a still."""

from collections.abc import Mapping
from typing import Any, Final

from colift.leaderboard.replays.chosen import made_replays
from colift.leaderboard.replays.html import SCENE, replay_data
from colift.leaderboard.replays.still import raised, still
from colift.leaderboard.views.page import Content, NoPageError, Page, Visit, find_season
from colift.leaderboard.views.replays import replays_in


def glance(visit: Visit, season: str) -> dict[str, Any] | None:
    """Return a lift of the first policy of a season; None if there is none to show.

    It is the median lift with the suite's first behaviour, or the last of a median session, if
    there is one: a ``replay``, and the
    ``data`` of the player, with the time ``raised_s`` at which the table is highest. ``digest`` is
    the policy's, ``scripts`` draw it. A service shows it once the replays are made.
    """
    first = next(iter(visit.board.tables.read(season).ranking), None)
    if first is None:
        return None
    digest = first.row.submission
    bundle = visit.board.bundle(season, digest)
    if bundle is None:
        return None
    made = made_replays(bundle) if visit.queue else replays_in(visit, season, digest)
    shown = [each for each in made if each["human"]]
    if not shown:
        return None
    replay = min(shown, key=_last_of_typical)
    return {
        "digest": digest,
        "scripts": (*SCENE, "glance.js"),
        "replay": replay,
        "data": {
            **replay_data([replay]),
            "raised_s": round((raised(replay) + 1) * replay["frame_s"], 2),
        },
    }


def _last_of_typical(replay: Mapping[str, Any]) -> tuple[bool, int]:
    """Return the smallest key for the median lift, or for the last one of the median session."""
    return replay["which"] not in ("median", None), -replay.get("lift", 0)


def _still(visit: Visit, season: str) -> Content:
    find_season(visit.board, season)
    shown = glance(visit, season)
    if shown is None:
        raise NoPageError(f"Season {season} has no lift to show.")
    return still(shown["replay"])


PAGES: Final = (
    Page(
        name="still",
        url="/seasons/{season}/still.png",
        file="data/{season}-still.png",
        view=_still,
        media="image/png",
        headers={"Cache-Control": "max-age=300"},
        meaning="A picture of a lift with the first policy of a season, for links elsewhere.",
    ),
)
