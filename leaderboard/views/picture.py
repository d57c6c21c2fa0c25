"""The scatter picture of a board: error on hidden lifts, and on public ones a second metric."""

from collections.abc import Sequence

from ...benchmark.comparison.front import FrontPoint, exact
from ...benchmark.comparison.scatter.scene import ScatterScene, make_scene
from ..board.standings import HumanHumanScores
from ..records.metrics import picture_axes
from ..records.row import BoardRow
from .bounds import PublicBound


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
        The policies, best first: RMSE on the hidden lifts, as in the table, and the second
        metric on the public ones.
    human_human
        The human-human baseline on the hidden lifts.
    bounds
        Those of the public lifts.
    size
        Width and height [px].
    """
    if not rows:
        return None
    leading, second = axes = picture_axes(rows[0].suite)
    policies = [
        FrontPoint(
            name=row.name,
            rmse_mm=row.hidden.rmse_mm,
            second=exact(row.public.metrics[second.name].mean),
            missing=row.public.metrics[second.name].missing,
        )
        for row in rows
    ]
    others = [
        FrontPoint(
            name=name, rmse_mm=each.rmse_mm, second=exact(each.means[second.name]), kind=kind
        )
        for name, each, kind in (
            *(() if human_human is None else [("two people", human_human, "baseline")]),
            *((bound.name, bound, "bound") for bound in bounds),
        )
    ]
    axis = f"← {leading.words.praise[1]} · {leading.symbol} on the hidden lifts, {leading.unit}"
    return make_scene([*policies, *others], axes, axis=axis, size=size)
