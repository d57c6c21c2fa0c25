"""The page of a policy: description, scores part by part, and history."""

import functools
import math
from collections.abc import Sequence
from typing import Final

from colift.benchmark.rendering.axis import make_axis
from colift.benchmark.results.curve import session_axis
from colift.benchmark.results.lifts import failures_by_reason, worst_of_behaviours
from colift.benchmark.results.parts import part_scores
from colift.leaderboard.client import API
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.standings import RANKED, RankedRow
from colift.leaderboard.database.schema import entries
from colift.leaderboard.views.lifts import (
    is_whole,
    part_estimate,
    public_lifts,
    session_of,
    stratum_scores,
)
from colift.leaderboard.views.page import Content, NoPageError, Page, Visit, find_season
from colift.leaderboard.views.replays import watchable

BLEND: Final = "blend"
"""The paper's method, with which every policy is compared."""


def policy_page(visit: Visit, season: str, digest: str) -> Content:
    """Return the row of a submission and its neighbours, or the reason for having none.

    ``shared`` is the number of policies of its rank, ``ranked`` that of those it is ranked
    with. ``parts`` are all lifts and each behaviour. The ``failures`` are reasons with their public
    lifts, the most frequent first; ``worst`` is the lift of each behaviour with the largest error,
    whose replay is shown; ``history`` are all entries of the same name, in all seasons, newest
    first.
    """
    board = visit.board
    info, mine = find_season(board, season), board.tables.row(season, digest)
    bundle = board.bundle(season, digest)
    content = {"season": info, "has_bundle": is_whole(bundle)}
    if mine is None:
        entry = board.entry(season, digest)
        if entry is None:
            raise NoPageError(f"Season {season} has no submission {digest[:16]}.")
        return {**content, "entry": entry, "template": "refusal.html"}
    ranks = board.tables.last_ranks(season)
    others = sorted(
        (each.row.submission for each in board.tables.rows(season, entries.c.name == BLEND)),
        key=lambda each: ranks.places.get(each, math.inf),
    )
    other = board.bundle(season, others[0]) if others and others[0] != digest else None
    fellows = ranks.fellows(digest) if mine.section in RANKED else ()
    lifts = () if bundle is None else public_lifts(bundle)
    parts = (
        ()
        if bundle is None
        else part_scores(
            stratum_scores(bundle),
            functools.partial(part_estimate, bundle),
            () if other is None else stratum_scores(other),
        )
    )
    curve = None if bundle is None else session_of(bundle)
    better, worse = _neighbours(board, season, fellows if mine.ranked else (), digest)
    public = mine.row.public
    return {
        **content,
        "standing": mine,
        "shared": ranks.shared(digest),
        "ranked": len(fellows),
        "parts": parts,
        "axis": make_axis(
            [each.rmse_mm for each in parts], [mark for each in parts for mark in each.marks]
        ),
        "session": curve,
        "session_axis": session_axis(curve),
        "never_lifted": public.failed == public.episodes,
        "failures": failures_by_reason(lifts),
        "worst": worst_of_behaviours(lifts),
        "better": better,
        "worse": worse,
        "history": tuple(reversed(board.entries_of(mine.row.name))),
        "events": mine.events,
        "has_replays": watchable(visit, season, digest),
    }


def _neighbours(
    board: Board, season: str, ranked: Sequence[str], digest: str
) -> tuple[RankedRow | None, RankedRow | None]:
    """Return the policies before and after one in the ranking, if they still are in it."""
    place = ranked.index(digest) if digest in ranked else None
    if place is None:
        return None, None
    around = (
        ranked[place - 1] if place else None,
        ranked[place + 1] if place + 1 < len(ranked) else None,
    )
    rows = [None if each is None else board.tables.row(season, each) for each in around]
    before, after = (each if each is not None and each.ranked else None for each in rows)
    return before, after


def _badge(visit: Visit, season: str, digest: str) -> Content:
    found = visit.board.tables.row(season, digest)
    if found is None:
        raise NoPageError(f"Season {season} has no row {digest[:16]}.")
    return {"standing": found}


PAGES: Final = (
    Page(
        name="policy",
        url="/seasons/{season}/policies/{digest}",
        file="policy-{season}-{digest:.16}.html",
        view=policy_page,
        template="policy.html",
        meaning="A submission: its scores, or why it has none.",
    ),
    Page(
        name="badge",
        url="/seasons/{season}/policies/{digest}/badge.svg",
        file="data/{season}-{digest:.16}.svg",
        view=_badge,
        template="badge.svg",
        media="image/svg+xml",
        headers={
            "Cross-Origin-Resource-Policy": "cross-origin",
            "Cache-Control": "max-age=300",
        },
        meaning="The badge of a row, for other sites.",
    ),
    Page(
        name="bundle",
        url=API + "/entries/{season}/{digest}/bundle.zip",
        file="data/{season}-{digest:.16}.zip",
    ),
)
