"""Other control periods and latencies: errors, claims, figure (section V.A)."""

import dataclasses
import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.control.predictor import PredictorParameters
from colift.benchmark.episode.scenario import LATENCY
from colift.benchmark.execution.runner import Run
from colift.benchmark.paper.evidence import Evidence, TimingSetting
from colift.benchmark.paper.exhibits import Claim, Exhibit
from colift.benchmark.paper.refilter import refilter
from colift.benchmark.paper.table_one import errors
from colift.benchmark.paper.watched import SampledLift, rms, sampled_lifts
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.panels import panels
from colift.benchmark.rendering.style import CONFIDENCE, FAINT, PREDICTION
from matplotlib.axes import Axes
from numpy.typing import NDArray

Series = NDArray[np.float64]

HORIZON: Final = 0.1
"""Horizon at which predictions of different control periods are compared [s]: the paper's step."""

MOVING: Final = 0.03
"""Speed [m/s] above which the human moves."""


@dataclass(frozen=True, kw_only=True)
class TimingResult:
    """Outcome of one setting; errors of predictions are NaN for a policy without predictions."""

    policy: str
    control_period_s: float
    latency_s: float
    rmse_mm: float
    one_step_mm: float
    """Root mean square error of the prediction of the next sample while the human moves [mm]."""
    one_step_ms: float
    """The same as time [ms]: divided by the root mean square speed."""
    ahead_mm: float
    """Root mean square error of a prediction ``HORIZON`` ahead while the human moves [mm]."""
    ahead_retuned_mm: float
    """The same, offline, with the process noise of :func:`retuned`."""


def timing_results(evidence: Evidence) -> list[TimingResult]:
    """Return the errors of each setting, in the order of the runs."""
    return [_result(*each, evidence.parameters) for each in evidence.timing.items()]


def at_papers_latency(results: Sequence[TimingResult], policy: str) -> list[TimingResult]:
    """Return a policy's results at the latency of Table I, or the next below, by period."""
    latency = max(r.latency_s for r in results if r.latency_s <= LATENCY)
    some = [r for r in results if r.policy == policy and r.latency_s == latency]
    return sorted(some, key=lambda result: result.control_period_s)


def _result(timing: TimingSetting, run: Run, parameters: PredictorParameters) -> TimingResult:
    one_step = one_step_ms = ahead = ahead_retuned = math.nan
    if timing.policy == "blend":
        lifts = sampled_lifts(run, parameters)
        speed = rms(np.concatenate([lift.speed[_moving(lift)] for lift in lifts]))
        one_step = _pooled(lifts, lambda lift: lift.errors)
        one_step_ms = one_step / speed
        ahead = _pooled(lifts, ahead_errors)
        ahead_retuned = _pooled(lifts, lambda lift: ahead_errors(lift, retuned(lift)))
    return TimingResult(
        policy=timing.policy,
        control_period_s=timing.control_period,
        latency_s=timing.latency,
        rmse_mm=float(errors(run.episodes).mean()),
        one_step_mm=one_step,
        one_step_ms=one_step_ms,
        ahead_mm=ahead,
        ahead_retuned_mm=ahead_retuned,
    )


def retuned(lift: SampledLift) -> PredictorParameters:
    """Return the predictor's parameters with the process noise of ``HORIZON``, for a lift's period.

    The filter assumes a jerk that is constant over a step, with variance q, whatever the step. Over
    a second such a jerk changes the acceleration by a variance of q times the period: with the same
    q, a filter trusts its model more at a shorter step. Here q times the period is kept constant.
    """
    motion = lift.parameters.motion
    noise = motion.process_noise * HORIZON / lift.scenario.control_period
    return dataclasses.replace(
        lift.parameters, motion=dataclasses.replace(motion, process_noise=noise)
    )


def _moving(lift: SampledLift) -> NDArray[np.bool_]:
    return lift.speed > MOVING


def _pooled(lifts: Sequence[SampledLift], wrong: Callable[[SampledLift], Series]) -> float:
    """Return the root mean square of an error over all steps in which the human moves [mm]."""
    return 1000 * rms(np.concatenate([wrong(lift)[_moving(lift)] for lift in lifts]))


def ahead_errors(lift: SampledLift, parameters: PredictorParameters | None = None) -> Series:
    """Return the errors of the predictions ``HORIZON`` ahead of the sample [m], shape (m,).

    The filter's prediction one step ahead is extrapolated at constant acceleration (eq. 5) to the
    horizon. Each error is in the step whose sample the prediction is compared with; steps before
    the first such sample have NaN. Computed offline, with the parameters of the lift by default.
    """
    period = lift.scenario.control_period
    refiltered = refilter(lift.samples, period, parameters or lift.parameters)
    further = HORIZON - period
    expected = (
        refiltered.height + refiltered.velocity * further + refiltered.acceleration * further**2 / 2
    )
    # The prediction of sample k, made one step ahead, is extrapolated to sample k + steps.
    steps = round(further / period)
    wrong = np.full(len(expected), np.nan)
    wrong[steps + 1 :] = lift.samples[steps + 1 :] - expected[1 : len(expected) - steps]
    return wrong


def timing_claims(evidence: Evidence) -> list[Claim]:
    """Return the claims about control period and latency."""
    results = timing_results(evidence)
    blends, reactives = (at_papers_latency(results, policy) for policy in ("blend", "reactive"))
    return [_next_sample(blends), _same_time(blends), _performs(blends, reactives)]


def _next_sample(blends: Sequence[TimingResult]) -> Claim:
    return Claim(
        claim="With a faster robot, more samples per second would improve the predictions (of the "
        "next sample).",
        figure="timing",
        paper="an expectation",
        criterion="the rms error one step ahead falls with every shorter period, in mm and as time",
        measured=f"{_listed(blends, 'one_step_mm')} mm, which is "
        f"{_listed(blends, 'one_step_ms', '.1f')} ms of motion",
        values=_values(blends, "one_step_mm"),
        holds=_rising(blends, "one_step_mm") and _rising(blends, "one_step_ms"),
        note="The next sample is nearer, which alone makes it easier; see the next claim.",
    )


def _same_time(blends: Sequence[TimingResult]) -> Claim:
    retuned = _rising(blends, "ahead_retuned_mm")
    return Claim(
        claim="More samples per second would improve the predictions (of the same 100 ms ahead).",
        figure="timing",
        paper="an expectation",
        criterion="the rms error 100 ms ahead falls with every shorter period",
        measured=f"{_listed(blends, 'ahead_mm')} mm",
        values=_values(blends, "ahead_mm") | _values(blends, "ahead_retuned_mm"),
        holds=_rising(blends, "ahead_mm"),
        note="The filter keeps its parameters, but q is the variance of a jerk that is constant "
        "over a step: the same q at a shorter step means less process noise per second, and a "
        "filter that trusts its own model more. With q times the period kept, computed "
        f"offline on the same samples, the errors are {_listed(blends, 'ahead_retuned_mm')} mm: "
        + (
            "more samples do help a filter that is tuned for them."
            if retuned
            else "more samples still do not help."
        ),
    )


def _performs(blends: Sequence[TimingResult], reactives: Sequence[TimingResult]) -> Claim:
    fast, slow = blends[0], blends[-1]
    gains = [
        1 - blend.rmse_mm / reactive.rmse_mm
        for blend, reactive in zip(blends, reactives, strict=True)
    ]
    return Claim(
        claim="A faster robot would offer a better improvement with the proposed technique.",
        figure="timing",
        paper="an expectation",
        criterion="at the shortest period, compared with the longest, the RMSE with prediction is "
        "lower and the fraction of the error that prediction removes is larger",
        measured=f"with prediction {_listed(blends, 'rmse_mm')} mm; without "
        f"{_listed(reactives, 'rmse_mm')} mm; prediction removes {gains[0]:.0%} at the shortest "
        f"and {gains[-1]:.0%} at the longest period",
        values=_values(blends, "rmse_mm") | {"gain_fast": gains[0], "gain_slow": gains[-1]},
        holds=fast.rmse_mm < slow.rmse_mm and gains[0] > gains[-1],
        note="The framework predicts one step ahead of the sample, and does not make up for the "
        f"sample's age. At {1000 * fast.control_period_s:.0f} ms a step that is "
        f"{1000 * fast.control_period_s:.0f} of the {1000 * fast.latency_s:.0f} ms by which the "
        "sample is old: the shorter the step, the less there is in a prediction.",
    )


def _listed(results: Sequence[TimingResult], attribute: str, digits: str = ".2f") -> str:
    return ", ".join(
        f"{1000 * result.control_period_s:.0f} ms: {format(getattr(result, attribute), digits)}"
        for result in results
    )


def _values(results: Sequence[TimingResult], attribute: str) -> dict[str, float | None]:
    return {
        f"{attribute.removesuffix('_mm')}_at_{1000 * r.control_period_s:.0f}_ms_mm": float(
            getattr(r, attribute)
        )
        for r in results
    }


def _rising(results: Sequence[TimingResult], attribute: str) -> bool:
    """Return whether an error grows with every longer period."""
    values = [getattr(result, attribute) for result in results]
    return all(a < b for a, b in itertools.pairwise(values))


BY_LATENCY: Final = (("#6BAED6", "o"), ("#3787C0", "s"), ("#105BA4", "^"), ("#08306B", "D"))
"""Colour and marker of the latencies, from the shortest to the longest."""

COLUMNS: Final = ("policy", "control_period_s", "latency_s", "rmse_mm", "one_step_mm")
COLUMNS_AHEAD: Final = ("one_step_ms", "ahead_mm", "ahead_retuned_mm")


def timing_exhibit(results: Sequence[TimingResult], layout: Layout) -> Exhibit:
    """Return errors over control period and latency."""
    figure, (row,) = panels(
        layout, ["error [mm]"], [3.0], columns=3, x_label="control period [ms]", share_x=False
    )
    for axes, policy in ((row[0], "reactive"), (row[1], "blend")):
        some = [result for result in results if result.policy == policy]
        latencies = sorted({result.latency_s for result in some})
        for latency, look in zip(latencies, BY_LATENCY, strict=False):
            chosen = [result for result in some if result.latency_s == latency]
            x, y = _line(axes, chosen, "rmse_mm", look)
            if policy == "blend":
                text = f"{1000 * latency:.0f} ms old"
                axes.annotate(
                    text, (x, y), (0, -5), textcoords="offset points", ha="right", va="top"
                )
    blends = at_papers_latency(results, "blend")
    _line(row[2], blends, "ahead_mm", (PREDICTION, "o"), "100 ms ahead")
    _line(row[2], blends, "ahead_retuned_mm", (CONFIDENCE, "s"), "same, retuned")
    _line(row[2], blends, "one_step_mm", (FAINT, "^"), "one step ahead")
    names = ("RMSE\nwithout prediction", "RMSE\nwith prediction", "rms error\nof the prediction")
    for axes, name in zip(row, names, strict=True):
        axes.set_title(name)
        axes.set_ylim(bottom=0)
        axes.set_xticks(sorted({1000 * result.control_period_s for result in results}))
    row[2].legend(loc="upper right")
    return Exhibit(
        name="timing",
        title="A faster robot, fresher samples",
        caption="Mean RMSE over the control period, for samples of different age (the "
        "latency, named in the second panel), and the rms error of prediction while the human "
        "moves, at the latency of Table I: one step ahead, and 100 ms ahead of the sample whatever "
        "the step. Retuned: with process noise that is as much a second at every period.",
        figure=figure,
        columns={
            name: [getattr(result, name) for result in results]
            for name in (*COLUMNS, *COLUMNS_AHEAD)
        },
    )


def _line(
    axes: Axes,
    results: Sequence[TimingResult],
    attribute: str,
    look: tuple[str, str],
    label: str | None = None,
) -> tuple[float, float]:
    """Draw a line in a colour, with a marker, and return its last point."""
    points = sorted((1000 * r.control_period_s, getattr(r, attribute)) for r in results)
    axes.plot(
        [x for x, _ in points],
        [y for _, y in points],
        color=look[0],
        marker=look[1],
        ms=4,
        lw=1.8,
        label=label,
    )
    return points[-1]
