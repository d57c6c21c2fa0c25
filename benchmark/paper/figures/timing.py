"""What a faster robot and fresher samples would bring (section V.A)."""

from collections.abc import Sequence
from typing import Final

from matplotlib.axes import Axes

from ...rendering.palette import FAINT, INK
from ..timing import TimingResult, at_papers_latency
from .picture import CONFIDENCE, PREDICTION, Picture, panels

BY_LATENCY: Final = ("#6BAED6", "#3787C0", "#105BA4", "#08306B")
"""From fresh to old."""

COLUMNS: Final = ("policy", "control_period_s", "latency_s", "rmse_mm", "one_step_mm")
COLUMNS_AHEAD: Final = ("one_step_ms", "ahead_mm", "ahead_retuned_mm")


def timing_picture(results: Sequence[TimingResult]) -> Picture:
    """Return errors over control period and latency."""
    figure, (row,) = panels(
        ["error [mm]"], [3.0], columns=3, x_label="control period [ms]", share_x=False
    )
    for axes, policy in ((row[0], "reactive"), (row[1], "blend")):
        some = [result for result in results if result.policy == policy]
        latencies = sorted({result.latency_s for result in some})
        for latency, colour in zip(latencies, BY_LATENCY, strict=False):
            chosen = [result for result in some if result.latency_s == latency]
            _line(axes, chosen, "rmse_mm", colour, f"{1000 * latency:.0f} ms old")
    blends = at_papers_latency(results, "blend")
    _line(row[2], blends, "ahead_mm", PREDICTION, "100 ms ahead")
    _line(row[2], blends, "ahead_retuned_mm", CONFIDENCE, "100 ms ahead, retuned")
    _line(row[2], blends, "one_step_mm", FAINT, "one step ahead")
    names = ("RMSE without prediction", "RMSE with prediction", "error of prediction")
    for axes, name in zip(row, names, strict=True):
        axes.set_title(name, fontsize=9, color=INK, loc="left")
        axes.set_ylim(bottom=0)
        axes.set_xticks(sorted({1000 * result.control_period_s for result in results}))
    row[0].legend(fontsize=8, labelcolor=INK, loc="lower right", ncols=2, edgecolor="none")
    row[2].legend(fontsize=8, labelcolor=INK, loc="upper right", edgecolor="none")
    return Picture(
        name="timing",
        title="A faster robot, fresher samples",
        caption="Mean RMSE over the control period, for samples of different age (the latency), "
        "and the rms error of prediction while the human moves, at the latency of Table I: one "
        "step ahead, and 100 ms ahead of the sample whatever the step. Retuned: with process noise "
        "that is as much a second at every period.",
        figure=figure,
        columns={
            name: [getattr(result, name) for result in results]
            for name in (*COLUMNS, *COLUMNS_AHEAD)
        },
    )


def _line(
    axes: Axes, results: Sequence[TimingResult], attribute: str, colour: str, label: str
) -> None:
    points = sorted((1000 * r.control_period_s, getattr(r, attribute)) for r in results)
    axes.plot(
        [x for x, _ in points],
        [y for _, y in points],
        color=colour,
        marker="o",
        ms=4,
        lw=1.8,
        label=label,
    )
