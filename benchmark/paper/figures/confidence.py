"""Figures 5 and 6: confidence along a lift, an ordinary one and one with a pause."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...rendering.palette import FAINT, HUMAN, INK
from ..sampled import SampledLift
from .picture import CONFIDENCE, PREDICTION, Picture, legend, panels, shade


def confidence_picture(lift: SampledLift) -> Picture:
    """Return figure 5 from one lift."""
    strokes = [
        (lift.step_showing(start), lift.step_showing(stop)) for start, stop in lift.plan.strokes
    ]
    figure, _ = _course(lift, strokes, "the human moves")
    return Picture(
        name="figure-5",
        title="Figure 5. Confidence together with predictions and observations",
        caption=f"Subject {lift.episode.subject}, seed {lift.episode.seed}. While the table is "
        "still, nothing is easier to predict: the confidence is high. It drops when the motion "
        "begins, and is mixed while it lasts. 1 leads, 0 follows.",
        figure=figure,
        columns=_columns(lift),
    )


def pause_picture(lift: SampledLift) -> Picture:
    """Return figure 6 from one lift that pauses."""
    onset, still, resume = (lift.step_showing(lift.event(e)) for e in ("brake", "pause", "resume"))
    figure, (upper, lower) = _course(lift, [(still, resume)], "the human stands still")
    for axes in (upper, lower):
        for step in (onset, resume):
            axes.axvline(step, color=INK, lw=0.9, ls=(0, (4, 3)))
    for step, word in ((onset, "begins to stop"), (resume, "goes on")):
        lower.annotate(
            word, (step, 1.02), ha="center", va="bottom", fontsize=8.5, color=FAINT, clip_on=False
        )
    return Picture(
        name="figure-6",
        title="Figure 6. An irregular case: a pause on the way up",
        caption=f"Subject {lift.episode.subject}, seed {lift.episode.seed}. The human stops half "
        "way, stands still for 2 s and goes on. The confidence falls with the first samples that "
        "show the braking, rises once stillness has become predictable, and falls again when the "
        "motion resumes.",
        figure=figure,
        columns=_columns(lift),
    )


def _course(
    lift: SampledLift, spans: Sequence[tuple[float, float]], label: str
) -> tuple[Figure, tuple[Axes, Axes]]:
    figure, ((upper,), (lower,)) = panels(["position [mm]", "confidence C"], [2.2, 1.6])
    steps = np.arange(len(lift.samples))
    shade(upper, spans, label)
    shade(lower, spans)
    upper.plot(steps, 1000 * lift.samples, color=HUMAN, lw=2.0, label="observed")
    upper.plot(
        steps, 1000 * lift.predicted, color=PREDICTION, lw=1.4, marker=".", ms=5, label="predicted"
    )
    lower.plot(steps, lift.confidence, color=CONFIDENCE, lw=2.0, marker=".", ms=5)
    lower.set_ylim(-0.03, 1.03)
    legend(upper)
    return figure, (upper, lower)


def _columns(lift: SampledLift) -> dict[str, list[float]]:
    return {
        "step": list(range(len(lift.samples))),
        "observed_position_m": lift.samples.tolist(),
        "predicted_position_m": lift.predicted.tolist(),
        "confidence": lift.confidence.tolist(),
    }
