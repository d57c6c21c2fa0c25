"""The page of a policy: what it is, what it did, part by part, and its history."""

from dataclasses import dataclass
from pathlib import Path
from typing import Final

from ...benchmark.comparison.standing import Estimate
from ..board import Board
from ..entry import Entry
from ..event import Event
from ..season import SeasonInfo
from ..standing import Standing
from .axis import Axis, make_axis
from .board import find_season, ordered_seasons
from .lifts import PublicLift, cell_scores, is_whole, public_lifts
from .parts import Part, estimate, mean_rmse, parts_of, team_rmse

BLEND: Final = "blend"
"""The paper's method, which every policy is set against."""


@dataclass(frozen=True, kw_only=True)
class PartScore:
    """What a policy did on a part of the public lifts, and what others did there."""

    part: Part
    episodes: int
    failed: int
    rmse_mm: Estimate
    team_mm: float | None
    """The human-human team's mean RMSE [mm]."""
    blend_mm: float | None
    """The mean RMSE of ``blend`` [mm], if it is on the board."""


@dataclass(frozen=True, kw_only=True)
class PolicyView:
    """What the page of a policy shows."""

    season: SeasonInfo
    standing: Standing
    shared: int
    """How many policies are in its rank group."""
    ranked: int
    """How many policies are in the ranking."""
    parts: tuple[PartScore, ...]
    axis: Axis
    failures: tuple[PublicLift, ...]
    """The public lifts that failed."""
    history: tuple[Entry, ...]
    """All entries of the same name, in all seasons, newest first."""
    events: tuple[Event, ...]
    has_bundle: bool
    """Whether the public run can be downloaded and verified."""

    @property
    def is_blend(self) -> bool:
        """Whether it is the policy that others are set against."""
        return self.standing.row.name == BLEND


@dataclass(frozen=True, kw_only=True)
class RefusalView:
    """What the page of a submission without a row shows."""

    season: SeasonInfo
    entry: Entry
    has_bundle: bool


def policy_view(board: Board, season: str, digest: str) -> PolicyView | RefusalView | None:
    """Return the page of a submission; None if the board knows no such submission."""
    info = find_season(ordered_seasons(board), season)
    if info is None:
        return None
    standings = board.standings(season)
    mine = next((each for each in standings if each.row.submission == digest), None)
    bundle = board.bundle(season, digest)
    if mine is None:
        entry = board.entry(season, digest)
        whole = is_whole(bundle)
        return None if entry is None else RefusalView(season=info, entry=entry, has_bundle=whole)
    blend = next((each.row.submission for each in standings if each.row.name == BLEND), None)
    other = None if blend in (None, digest) else board.bundle(season, str(blend))
    parts = () if bundle is None else _parts(bundle, other)
    marks = [mark for each in parts for mark in (each.team_mm, each.blend_mm) if mark is not None]
    return PolicyView(
        season=info,
        standing=mine,
        shared=sum(each.group == mine.group for each in standings),
        ranked=sum(each.ranked for each in standings),
        parts=parts,
        axis=make_axis([each.rmse_mm for each in parts], marks),
        failures=_failures(bundle),
        history=tuple(reversed(board.entries_of(mine.row.name))),
        events=mine.events,
        has_bundle=is_whole(bundle),
    )


def _failures(bundle: Path | None) -> tuple[PublicLift, ...]:
    if bundle is None:
        return ()
    return tuple(lift for lift in public_lifts(bundle) if lift.failure is not None)


def _parts(bundle: Path, other: Path | None) -> tuple[PartScore, ...]:
    """Return the parts of a bundle's lifts, beside another policy's."""
    cells = cell_scores(bundle)
    others = () if other is None else cell_scores(other)
    found = []
    for part in parts_of(cells):
        some = [cell for cell in cells if part.has(cell)]
        found.append(
            PartScore(
                part=part,
                episodes=sum(cell.episodes for cell in some),
                failed=sum(cell.failed for cell in some),
                rmse_mm=estimate(bundle, part),
                team_mm=team_rmse(some),
                blend_mm=mean_rmse(others, part),
            )
        )
    return tuple(found)
