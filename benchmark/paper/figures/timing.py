"""What a faster robot and fresher samples would bring (section V.A)."""

from collections.abc import Sequence

from matplotlib.axes import Axes

from ...rendering.palette import INK
from ..timing import TimingResult
from .picture import Picture, legend, panels

_BLUES = ("#08306B", "#2171B5", "#6BAED6", "#B8A13A", "#D55E00", "#7F2704")


def timing_picture(results: Sequence[TimingResult]) -> Picture:
    """Return errors over control period and latency."""
    figure, (row,) = panels(
        ["error [mm]"], [2.8], columns=3, x_label="control period [ms]", share_x=False
    )
    blends = [result for result in results if result.policy == "blend"]
    reactives = [result for result in results if result.policy == "reactive"]
    for axes, name, some, attribute in (
        (row[0], "RMSE without prediction", reactives, "rmse_mm"),
        (row[1], "RMSE with prediction", blends, "rmse_mm"),
        (row[2], "prediction 100 ms ahead, rms", blends, "ahead_mm"),
    ):
        _lines(axes, some, attribute)
        axes.set_title(name, fontsize=9, color=INK, loc="left", pad=22 if axes is row[0] else 6)
    row[0].set_ylim(bottom=0)
    legend(row[0], columns=4)
    names = ("policy", "control_period_s", "latency_s", "rmse_mm", "one_step_mm")
    names += ("one_step_ms", "ahead_mm")
    return Picture(
        name="timing",
        title="A faster robot, fresher samples",
        caption="Mean error over control period and latency (the colours), on the same lifts. The "
        "last panel is the error of predicting the human's end 100 ms ahead of the sample while "
        "the human moves, a fixed time, so that it is fair to all periods.",
        figure=figure,
        columns={name: [getattr(result, name) for result in results] for name in names},
    )


def _lines(axes: Axes, results: Sequence[TimingResult], attribute: str) -> None:
    latencies = sorted({result.latency_s for result in results})
    for latency, colour in zip(latencies, _BLUES, strict=False):
        points = sorted(
            (1000 * result.control_period_s, getattr(result, attribute))
            for result in results
            if result.latency_s == latency
        )
        axes.plot(
            [x for x, _ in points],
            [y for _, y in points],
            color=colour,
            marker="o",
            ms=4,
            lw=1.8,
            label=f"{1000 * latency:.0f} ms",
        )
    axes.set_xticks(sorted({1000 * result.control_period_s for result in results}))
