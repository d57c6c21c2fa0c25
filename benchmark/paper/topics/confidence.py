"""Confidence at rest, at the onset, in a pause and in motion: claims, figures 5 and 6 (IV.C, D)."""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from colift.benchmark.paper.exhibits import STEPS, Claim, Exhibit, shade
from colift.benchmark.paper.topics.timing import MOVING
from colift.benchmark.paper.watched import SampledLift
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.panels import legend, panels
from colift.benchmark.rendering.style import CONFIDENCE, DASHES, FAINT, HUMAN, INK, PREDICTION
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

Series = NDArray[np.float64]

HIGH: Final = 0.7
LOW: Final = 0.3
LEAD: Final = 0.5
"""Confidence above which the robot leads more than it follows."""

STEADY: Final = (0.35, 0.7)
"""Range of the mean confidence in steady motion."""

HELD: Final = 0.01
"""Largest movement of the robot's end that counts as holding [m]."""

REST: Final = 10
"""Steps at the end of a pause, 1 s, in which everything should be at rest."""


def confidence_claims(lifts: Sequence[SampledLift], pauses: Sequence[SampledLift]) -> list[Claim]:
    """Return the claims about ordinary lifts and about lifts that pause."""
    return [
        _still(lifts),
        _onset(lifts),
        _falls(pauses),
        _holds(pauses),
        _resumes(pauses),
        _steady(lifts),
    ]


def aligned(
    lifts: Sequence[SampledLift], step: Callable[[SampledLift], int], before: int, after: int
) -> Series:
    """Return the confidence around one step of each lift, shape (lifts, before + after)."""
    return np.array([lift.confidence[step(lift) - before : step(lift) + after] for lift in lifts])


def _still(lifts: Sequence[SampledLift]) -> Claim:
    values = np.concatenate([lift.confidence[: lift.first_motion] for lift in lifts])
    mean, low = float(values.mean()), float(np.quantile(values, 0.05))
    return Claim(
        claim="The confidence is high at the beginning, when the table is still.",
        figure="figure 5",
        paper="in words only",
        criterion=f"mean above {HIGH} before the first sample that shows motion",
        measured=f"mean {mean:.2f}, lowest twentieth {low:.2f}",
        values={"mean": mean, "p05": low},
        holds=mean > HIGH,
    )


def _onset(lifts: Sequence[SampledLift]) -> Claim:
    profile = aligned(lifts, lambda lift: lift.first_motion, 0, 10)
    mean = profile.mean(axis=0)
    lowest = int(mean.argmin())
    return Claim(
        claim="When the motion begins, the confidence drops suddenly, and then improves as the "
        "predictor gains knowledge of the motion.",
        figure="figure 5",
        paper="in words only",
        criterion=f"the mean over the lifts falls below {LEAD} within 5 steps of motion, and is "
        "above that again within 10",
        measured=f"lowest {mean[lowest]:.2f} in step {lowest + 1} of the motion, then up to "
        f"{mean[lowest:].max():.2f} by step 10",
        values={"lowest": float(mean[lowest]), "recovered": float(mean[lowest:].max())},
        holds=bool(mean[:5].min() < LEAD and mean[lowest:].max() > LEAD),
    )


def _falls(pauses: Sequence[SampledLift]) -> Claim:
    profile = aligned(pauses, lambda lift: lift.step_showing(lift.event("brake")), 1, 8)
    before, first, second, third, fourth, fifth, *_ = profile.mean(axis=0).tolist()
    fraction = float(((profile[:, 4] < LOW) & (profile[:, 5] < 0.2)).mean())
    steps = ", ".join(f"{value:.2f}" for value in (first, second, third, fourth, fifth))
    return Claim(
        claim="The confidence falls to zero within 3 to 4 steps of the abrupt change.",
        figure="figure 6",
        paper="3 to 4 steps to zero",
        criterion="mean over the lifts below 0.3 in the fourth step that shows the braking and "
        "below 0.2 one step later",
        measured=f"{before:.2f} before, then {steps} in steps 1 to 5; both limits are met in "
        f"{fraction:.0%} of the lifts",
        values={
            "before": before,
            "step_1": first,
            "step_2": second,
            "step_3": third,
            "step_4": fourth,
            "step_5": fifth,
            "share_of_lifts": fraction,
        },
        holds=fourth < LOW and fifth < 0.2,
        note="Step 1 is the first sample taken after the human began to brake; braking takes 0.4 "
        "to 0.7 s.",
    )


def _holds(pauses: Sequence[SampledLift]) -> Claim:
    confidence, moved = [], []
    for lift in pauses:
        resume = lift.event("resume")
        step = lift.step_showing(resume)
        confidence.append(float(lift.confidence[step - REST : step].mean()))
        frames = REST * lift.scenario.frames_per_step
        moved.append(float(np.ptp(lift.episode.trace.robot_end[resume - frames : resume])))
    mean, holding = float(np.mean(confidence)), float(np.mean([d < HELD for d in moved]))
    return Claim(
        claim="As the human keeps still, the confidence is high again, and the robot, now the "
        "leader, does not move, since the predicted change is zero.",
        figure="figure 6",
        paper="in words only",
        criterion=f"mean above {LEAD} in the last second of the pause; the robot's end moves by "
        "less than 10 mm in it, in at least 95 % of the lifts",
        measured=f"mean confidence {mean:.2f}; the robot's end moves by "
        f"{1000 * np.mean(moved):.1f} mm on average, {1000 * max(moved):.1f} mm at most",
        values={
            "confidence": mean,
            "moved_mm": 1000 * float(np.mean(moved)),
            "share_holding": holding,
        },
        holds=mean > LEAD and holding >= 0.95,
    )


def _resumes(pauses: Sequence[SampledLift]) -> Claim:
    profile = aligned(pauses, lambda lift: lift.step_showing(lift.event("resume")), 1, 8)
    mean = profile.mean(axis=0)
    return Claim(
        claim="When the human goes on, the robot switches from leader to follower.",
        figure="figure 6",
        paper="in words only",
        criterion=f"the mean over the lifts falls from above to below {LEAD} within 5 steps",
        measured=f"{mean[0]:.2f} before, lowest {mean[1:6].min():.2f} in step "
        f"{int(mean[1:6].argmin()) + 1}",
        values={"before": float(mean[0]), "lowest": float(mean[1:6].min())},
        holds=bool(mean[0] > LEAD > mean[1:6].min()),
    )


def _steady(lifts: Sequence[SampledLift]) -> Claim:
    values = moving_confidence(lifts)
    mean = float(values.mean())
    low, high = (float(np.quantile(values, q)) for q in (0.25, 0.75))
    return Claim(
        claim="In steady motion the confidence is centred somewhere around 0.5.",
        figure="figures 5 and 6",
        paper="around 0.5",
        criterion=f"mean within {STEADY[0]} to {STEADY[1]} while the human is faster than 3 cm/s",
        measured=f"mean {mean:.2f}, middle half {low:.2f} to {high:.2f}",
        values={"mean": mean, "q25": low, "q75": high},
        holds=STEADY[0] <= mean <= STEADY[1],
    )


def moving_confidence(lifts: Sequence[SampledLift]) -> Series:
    """Return the confidence in all steps in which the human moves."""
    return np.concatenate([lift.confidence[lift.speed > MOVING] for lift in lifts])


def confidence_exhibit(lift: SampledLift, layout: Layout) -> Exhibit:
    """Return figure 5 from one lift."""
    strokes = [
        (lift.step_showing(start), lift.step_showing(stop)) for start, stop in lift.plan.strokes
    ]
    figure, _ = _panels(lift, strokes, "the human moves", layout)
    return Exhibit(
        name="figure-5",
        title="Figure 5. Confidence together with predictions and observations",
        caption=f"Subject {lift.episode.subject}, seed {lift.episode.seed}. While the table is "
        "still, nothing is easier to predict: the confidence is high. It drops when the motion "
        "begins, and is mixed while it lasts. 1 leads, 0 follows.",
        figure=figure,
        columns=_columns(lift),
    )


def pause_exhibit(lift: SampledLift, layout: Layout) -> Exhibit:
    """Return figure 6 from one lift that pauses."""
    onset, still, resume = (lift.step_showing(lift.event(e)) for e in ("brake", "pause", "resume"))
    figure, (upper, lower) = _panels(lift, [(still, resume)], "the human stands still", layout)
    lower.set_ylim(top=1.35)
    lower.set_yticks([0.0, 0.5, 1.0])
    for step, word, side in ((onset, "brakes", "right"), (resume, "goes on", "left")):
        upper.axvline(step, color=INK, lw=0.9, ls=DASHES)
        lower.axvline(step, color=INK, lw=0.9, ls=DASHES)
        lower.annotate(f" {word} ", (step, 1.05), ha=side, va="bottom", color=FAINT)
    return Exhibit(
        name="figure-6",
        title="Figure 6. An irregular case: a pause on the way up",
        caption=f"Subject {lift.episode.subject}, seed {lift.episode.seed}. The human stops half "
        "way, stands still for 2 s and goes on. The confidence falls with the first samples that "
        "show the braking, rises once stillness has become predictable, and falls again when the "
        "motion resumes.",
        figure=figure,
        columns=_columns(lift),
    )


def _panels(
    lift: SampledLift, spans: Sequence[tuple[float, float]], label: str, layout: Layout
) -> tuple[Figure, tuple[Axes, Axes]]:
    figure, ((upper,), (lower,)) = panels(
        layout, ["position [mm]", "confidence C"], [2.2, 1.6], x_label=STEPS
    )
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
