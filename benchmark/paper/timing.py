"""Errors of control and of prediction for other control periods and latencies (section V.A)."""

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ...agents.policies.predictor import PredictorParameters
from ..runner import Run
from ..scenario import LATENCY
from .evidence import Timing
from .measures import rms
from .replay import replay
from .sampled import SampledLift, sampled_lifts
from .table_one import errors

Series = NDArray[np.float64]

HORIZON: Final = 0.1
"""How far ahead predictions of different control periods are compared [s]: the paper's step."""

MOVING: Final = 0.03
"""Speed [m/s] above which the human moves."""


@dataclass(frozen=True, kw_only=True)
class TimingResult:
    """What came of one setting; predictions only where there are any (NaN elsewhere)."""

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


def timing_results(runs: Mapping[Timing, Run]) -> list[TimingResult]:
    """Return the errors of each setting, in the order of the runs."""
    return [_result(timing, run) for timing, run in runs.items()]


def at_papers_latency(results: Sequence[TimingResult], policy: str) -> list[TimingResult]:
    """Return a policy's results at the latency of Table I, or the next below, by period."""
    latency = max(r.latency_s for r in results if r.latency_s <= LATENCY)
    some = [r for r in results if r.policy == policy and r.latency_s == latency]
    return sorted(some, key=lambda result: result.control_period_s)


def _result(timing: Timing, run: Run) -> TimingResult:
    one_step = one_step_ms = ahead = ahead_retuned = math.nan
    if timing.policy == "blend":
        lifts = sampled_lifts(run)
        speed = rms(np.concatenate([lift.speed[_moving(lift)] for lift in lifts]))
        one_step = _pooled(lifts, lambda lift: lift.errors)
        one_step_ms = one_step / speed
        ahead = _pooled(lifts, ahead_errors)
        other = retuned(timing.control_period)
        ahead_retuned = _pooled(lifts, lambda lift: ahead_errors(lift, other))
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


def retuned(period: float) -> PredictorParameters:
    """Return the predictor's parameters with the process noise of ``HORIZON``, for a period [s].

    The filter takes the jerk for constant over a step with variance q, whatever the step. Over a
    second such a jerk changes the acceleration by a variance of q times the period: a filter with
    the same q trusts its model the more, the shorter the step. Here q times the period stays.
    """
    shipped = PredictorParameters()
    noise = shipped.motion.process_noise * HORIZON / period
    return dataclasses.replace(
        shipped, motion=dataclasses.replace(shipped.motion, process_noise=noise)
    )


def _moving(lift: SampledLift) -> NDArray[np.bool_]:
    return lift.speed > MOVING


def _pooled(lifts: Sequence[SampledLift], wrong: Callable[[SampledLift], Series]) -> float:
    """Return the root mean square of an error over all steps in which the human moves [mm]."""
    return 1000 * rms(np.concatenate([wrong(lift)[_moving(lift)] for lift in lifts]))


def ahead_errors(lift: SampledLift, parameters: PredictorParameters | None = None) -> Series:
    """Return how wrong the predictions ``HORIZON`` ahead of the sample are [m], shape (m,).

    The filter's prediction one step ahead is carried on at constant acceleration (eq. 5) to the
    horizon. The error stands in the step whose sample it is checked against; NaN before there is
    a prediction for one. Computed offline, with the shipped parameters by default.
    """
    period = lift.scenario.control_period
    replayed = replay(lift.samples, period, parameters)
    further = HORIZON - period
    expected = (
        replayed.height + replayed.velocity * further + replayed.acceleration * further**2 / 2
    )
    # What was expected of sample k, one step ahead, reaches to sample k + steps.
    steps = round(further / period)
    wrong = np.full(len(expected), np.nan)
    wrong[steps + 1 :] = lift.samples[steps + 1 :] - expected[1 : len(expected) - steps]
    return wrong
