"""The scatter picture of a board: error on hidden lifts against smoothness on public ones."""

from collections.abc import Sequence
from typing import Final

from ...benchmark.comparison.front import FrontPoint, exact
from ...benchmark.comparison.scatter.scene import ScatterScene, make_scene
from ..board.standings import HumanHumanScores
from ..records.row import BoardRow
from .bounds import PublicBound

AXIS: Final = "← more level · RMSE on the hidden lifts, mm"


def make_picture(
    rows: Sequence[BoardRow],
    human_human: HumanHumanScores | None,
    bounds: Sequence[PublicBound] = (),
    *,
    size: tuple[int, int],
) -> ScatterScene | None:
    """Return the picture; None if there is no policy.

    Parameters
    ----------
    rows
        The policies, best first: RMSE on the hidden lifts, as in the table, and smoothness on the
        public ones.
    human_human
        The human-human baseline on the hidden lifts.
    bounds
        Those of the public lifts.
    size
        Width and height [px].
    """
    if not rows:
        return None
    policies = [
        FrontPoint(
            name=row.name,
            rmse_mm=row.hidden.rmse_mm,
            sparc=exact(row.public.metrics["sparc"].mean),
            missing=row.public.metrics["sparc"].missing,
        )
        for row in rows
    ]
    others = [
        FrontPoint(name=name, rmse_mm=each.rmse_mm, sparc=exact(each.means["sparc"]), kind=kind)
        for name, each, kind in (
            *(() if human_human is None else [("two people", human_human, "baseline")]),
            *((bound.name, bound, "bound") for bound in bounds),
        )
    ]
    return make_scene([*policies, *others], axis=AXIS, size=size)
