"""Figures 8 and 9: both ends of the table and the difference between them."""

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure

from ....agents.agent import FRAME
from ...episode import Episode
from ...rendering.palette import FAINT, HUMAN, INK, ROBOT
from .picture import Picture, legend, panels


def comparison_picture(blend: Episode, reactive: Episode) -> Picture:
    """Return figure 8: the same lift with and without prediction."""
    return Picture(
        name="figure-8",
        title="Figure 8. With and without prediction",
        caption=f"Subject {blend.subject}, seed {blend.seed}: the same intention of the human in "
        "both cases. Above the trajectories of the two ends, below the absolute error, whose sum "
        "over the frames is eq. 10.",
        figure=_figure(
            {"case I: with prediction": blend, "case II: without": reactive},
            "robot's end",
            error_limit(blend, reactive),
        ),
        columns={**_columns(blend, "with_"), **_columns(reactive, "without_", time=False)},
    )


def error_limit(*episodes: Episode) -> float:
    """Return where the axis of the absolute error ends for it to hold all episodes [mm]."""
    traces = [episode.trace for episode in episodes]
    return 1050 * max(float(np.abs(t.human_end - t.robot_end).max()) for t in traces)


def team_picture(team: Episode, limit: float) -> Picture:
    """Return figure 9: two humans, the error's axis up to ``limit`` [mm]."""
    return Picture(
        name="figure-9",
        title="Figure 9. A human-human team",
        caption=f"Subject {team.subject}, seed {team.seed}, with a second human at the far end "
        "instead of the robot: the same intention as in figure 8, and the same scale of the error.",
        figure=_figure({"two humans": team}, "partner's end", limit),
        columns=_columns(team, ""),
    )


def _figure(cases: Mapping[str, Episode], far: str, limit: float) -> Figure:
    figure, (upper, lower) = panels(
        ["height [mm]", "|Z1 - Z2| [mm]"],
        [2.2, 1.4],
        columns=len(cases),
        x_label="time [s]",
        share_x=False,
    )
    for above, below, (name, episode) in zip(upper, lower, cases.items(), strict=True):
        trace, scores = episode.trace, episode.scores
        times = np.arange(1, len(trace.human_end) + 1) * FRAME
        above.plot(times, 1000 * trace.human_end, color=HUMAN, lw=1.8, label="human's end")
        above.plot(times, 1000 * trace.robot_end, color=ROBOT, lw=1.8, label=far)
        error = 1000 * np.abs(trace.human_end - trace.robot_end)
        below.fill_between(times, error, color=FAINT, alpha=0.35, lw=0)
        below.plot(times, error, color=FAINT, lw=1.0)
        above.set_title(
            f"{name}\nRMSE {scores.rmse_mm:.1f} mm, absolute error {scores.abs_error_mm:.0f} mm, "
            f"SPARC {scores.sparc:.2f}",
            fontsize=9,
            color=INK,
            loc="left",
            pad=20,
        )
        legend(above)
    for below in lower:
        below.set_ylim(0, limit)
    return figure


def _columns(episode: Episode, prefix: str, *, time: bool = True) -> dict[str, list[float]]:
    trace = episode.trace
    columns = {
        f"{prefix}human_end_m": trace.human_end.tolist(),
        f"{prefix}robot_end_m": trace.robot_end.tolist(),
    }
    if not time:
        return columns
    times = (np.arange(1, len(trace.human_end) + 1) * FRAME).round(2)
    return {"time_s": times.tolist(), **columns}
