"""Predictions of position, velocity and acceleration: claims, figure 4 (section IV.B)."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from colift.benchmark.paper.exhibits import STEPS, Claim, Exhibit, p_value_text
from colift.benchmark.paper.table_one import single_lifts
from colift.benchmark.paper.watched import SampledLift, rms
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.panels import legend, panels
from colift.benchmark.rendering.style import HUMAN, PREDICTION
from colift.benchmark.statistics import paired_permutation_p
from numpy.typing import NDArray

Series = NDArray[np.float64]


INITIAL: Final = 10
"""Steps after which the estimates improve, according to the paper."""

SMALL: Final = 0.1
"""Fraction of the peak speed below which a difference of velocities counts as very small."""

LONGEST_TRAIL: Final = 5
"""Largest number of steps by which a predicted velocity may trail the calculated one; all
velocities are compared from that step on."""

CENTRED: Final = 0.1
"""Fraction of its root mean square within which a mean counts as zero."""

_QUANTITIES = ("position", "velocity", "acceleration")


def derivatives(lift: SampledLift) -> tuple[Series, Series]:
    """Return velocity [m/s] and acceleration [m/s2] of the samples by central differences.

    Both have shape (m,), one value per sample.
    """
    period = lift.scenario.control_period
    velocity = np.gradient(lift.samples, period)
    return velocity, np.gradient(velocity, period)


def prediction_claims(lifts: Sequence[SampledLift]) -> list[Claim]:
    """Return the claims about predicted position, velocity and acceleration."""
    return [_improves(lifts), _velocity(lifts), _acceleration(lifts)]


def _improves(lifts: Sequence[SampledLift]) -> Claim:
    early, late, rest = (
        np.array([1000 * rms(lift.errors[_after(lift, *span)]) for lift in lifts])
        for span in ((0, INITIAL), (INITIAL, 2 * INITIAL), (INITIAL, None))
    )
    p = paired_permutation_p(early, late, single_lifts(early))
    worst, relative = _profile(lifts)
    stroke = float(np.mean([_stroke_steps(lift) for lift in lifts]))
    means = early.mean(), late.mean(), rest.mean()
    return Claim(
        claim="Predictions are inaccurate in the initial steps of the motion; after about 10 steps "
        "the estimates improve.",
        figure="figure 4",
        paper="in words only",
        criterion="the rms error of position is lower in steps 11 to 20 of the motion than in "
        "steps 1 to 10, paired p < 0.01",
        measured=f"{means[0]:.2f} mm in steps 1 to 10, {means[1]:.2f} mm in steps 11 to 20 "
        f"({p_value_text(p)}), {means[2]:.2f} mm from step 11 to the end of the lift",
        values={"early_mm": means[0], "late_mm": means[1], "after_mm": means[2], "p": p},
        holds=bool(means[1] < means[0] and p < 0.01),
        note=f"The error is largest in step {worst} of strokes that last {stroke:.0f} steps on "
        "average. The filter takes the acceleration for constant and errs where it changes: as "
        "the motion begins, and again when the human turns from speeding up to slowing down, "
        "where speed is highest. Relative to the speed the claim is seen: rms error / rms distance "
        f"per step is {relative[0]:.2f} in steps 1 to 5, "
        f"{relative[1]:.2f} in 6 to 10, {relative[2]:.2f} in 11 to 20.",
    )


def _after(lift: SampledLift, first: int, last: int | None) -> slice:
    """Return the steps from the beginning of the motion on, ``first`` counted from 0."""
    start = lift.first_motion
    return slice(start + first, None if last is None else start + last)


def _stroke_steps(lift: SampledLift) -> float:
    start, stop = lift.plan.strokes[0]
    return float(stop - start) / lift.scenario.frames_per_step


def _profile(lifts: Sequence[SampledLift]) -> tuple[int, tuple[float, float, float]]:
    """Return the step of the largest error, and errors relative to the distance of a step."""
    aligned = [lift.errors[_after(lift, 0, 2 * INITIAL)] for lift in lifts]
    moved = [
        np.diff(lift.samples, prepend=lift.samples[0])[_after(lift, 0, 2 * INITIAL)]
        for lift in lifts
    ]
    errors, distances = np.array(aligned), np.array(moved)
    profile = np.sqrt((errors**2).mean(axis=0))
    half = INITIAL // 2
    spans = (slice(0, half), slice(half, INITIAL), slice(INITIAL, 2 * INITIAL))
    first, second, third = (rms(errors[:, span]) / rms(distances[:, span]) for span in spans)
    return int(profile.argmax()) + 1, (first, second, third)


def _velocity(lifts: Sequence[SampledLift]) -> Claim:
    peak = float(np.mean([np.abs(derivatives(lift)[0]).max() for lift in lifts]))
    trailing = [
        float(np.mean([_velocity_difference(lift, steps) for lift in lifts]))
        for steps in range(LONGEST_TRAIL)
    ]
    steps, fraction = int(np.argmin(trailing)), trailing[0] / peak
    return Claim(
        claim="The difference between the predicted and the calculated velocity is very small.",
        figure="figure 4",
        paper="in words only",
        criterion="rms difference over the lift below 10 % of the peak speed",
        measured=f"rms difference {1000 * trailing[0]:.1f} mm/s, mean peak speed "
        f"{1000 * peak:.0f} mm/s: {100 * fraction:.1f} %",
        values={"difference_mm_s": 1000 * trailing[0], "share": fraction},
        holds=fraction < SMALL,
        note="The calculated velocity is the central difference of the samples. The predicted one "
        f"trails it ({trailing[steps] / peak:.1%} from the velocity of {100 * steps} ms earlier) "
        f"and overshoots: its peak is {_predicted_peak(lifts) / peak:.2f} times that calculated.",
    )


def _predicted_peak(lifts: Sequence[SampledLift]) -> float:
    """Return the mean peak of the predicted speed [m/s]."""
    return float(
        np.mean([np.nanmax(np.abs(lift.one_step_ahead("predicted_velocity"))) for lift in lifts])
    )


def _velocity_difference(lift: SampledLift, trailing: int) -> float:
    """Return the rms difference of the predicted velocity and an earlier calculated one [m/s]."""
    velocity, _ = derivatives(lift)
    predicted = lift.one_step_ahead("predicted_velocity")
    return rms(predicted[LONGEST_TRAIL:] - np.roll(velocity, trailing)[LONGEST_TRAIL:])


def _acceleration(lifts: Sequence[SampledLift]) -> Claim:
    means, sizes, changes = [], [], []
    for lift in lifts:
        _, acceleration = derivatives(lift)
        means.append(float(acceleration.mean()))
        sizes.append(rms(acceleration))
        changes.append(rms(np.diff(acceleration)))
    mean, size, change = (float(np.mean(values)) for values in (means, sizes, changes))
    return Claim(
        claim="The calculated acceleration remains centred at 0 with small changes.",
        figure="figure 4",
        paper="in words only",
        criterion="mean within 10 % of its rms",
        measured=f"mean {1000 * mean:.1f} mm/s², rms {1000 * size:.0f} mm/s², rms change from step "
        f"to step {1000 * change:.0f} mm/s²",
        values={
            "mean_mm_s2": 1000 * mean,
            "rms_mm_s2": 1000 * size,
            "change_mm_s2": 1000 * change,
        },
        holds=abs(mean) < CENTRED * size,
        note="Any movement from rest to rest has a mean near 0. The changes are "
        f"{change / size:.0%} of the acceleration in every step, which supports the assumption of "
        "a nearly constant acceleration only partly, as the paper says.",
    )


def prediction_exhibit(lift: SampledLift, layout: Layout) -> Exhibit:
    """Return figure 4 from one lift."""
    velocity, acceleration = derivatives(lift)
    observed = (lift.samples, velocity, acceleration)
    names = ("prediction", "predicted_velocity", "predicted_acceleration")
    predicted = [lift.one_step_ahead(name) for name in names]
    units = ("mm", "mm/s", "mm/s²")
    figure, rows = panels(
        layout,
        [f"{name} [{unit}]" for name, unit in zip(_QUANTITIES, units, strict=True)],
        [1.9, 1.5, 1.5],
        x_label=STEPS,
    )
    steps = np.arange(len(lift.samples))
    for (axes,), seen, expected in zip(rows, observed, predicted, strict=True):
        axes.plot(steps, 1000 * seen, color=HUMAN, lw=2.0, label="observed")
        axes.plot(
            steps, 1000 * expected, color=PREDICTION, lw=1.4, marker=".", ms=5, label="predicted"
        )
    legend(rows[0][0])
    columns = {"step": steps.tolist()}
    for name, seen, expected in zip(_QUANTITIES, observed, predicted, strict=True):
        columns[f"observed_{name}_m"] = seen.tolist()
        columns[f"predicted_{name}_m"] = expected.tolist()
    return Exhibit(
        name="figure-4",
        title="Figure 4. Predictions of the Kalman filter",
        caption=f"Subject {lift.episode.subject}, seed {lift.episode.seed}. What was predicted of "
        "each sample one step (100 ms) earlier, against what was then observed; observed velocity "
        "and acceleration are central differences of the observed position. (CSV: m, m/s, m/s².)",
        figure=figure,
        columns=columns,
    )
