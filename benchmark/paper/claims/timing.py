"""Claims about a faster robot (section V.A)."""

import itertools
from collections.abc import Mapping

from ...runner import Run
from ..evidence import Timing
from ..timing import TimingResult, timing_results
from .claim import Claim


def timing_claims(runs: Mapping[Timing, Run]) -> list[Claim]:
    """Return the claims about control period and latency."""
    results = timing_results(runs)
    latency = max(result.latency_s for result in results if result.latency_s <= 0.1)
    blends = sorted(
        (r for r in results if r.policy == "blend" and r.latency_s == latency),
        key=lambda result: result.control_period_s,
    )
    reactives = {
        r.control_period_s: r for r in results if r.policy == "reactive" and r.latency_s == latency
    }
    return [_predicts(blends), _levels(blends, reactives)]


def _told(results: list[TimingResult], attribute: str, digits: str = ".2f") -> str:
    return ", ".join(
        f"{1000 * r.control_period_s:.0f} ms: {format(getattr(r, attribute), digits)}"
        for r in results
    )


def _predicts(blends: list[TimingResult]) -> Claim:
    ahead = [result.ahead_mm for result in blends]
    rising = all(a < b for a, b in itertools.pairwise(ahead))
    return Claim(
        claim="With a faster robot, more samples a second would improve the predictions.",
        figure="timing",
        paper="an expectation",
        criterion="the rms error of predicting 100 ms ahead falls with every shorter period",
        measured=f"100 ms ahead {_told(blends, 'ahead_mm')} mm; one step ahead "
        f"{_told(blends, 'one_step_mm')} mm, which is {_told(blends, 'one_step_ms', '.1f')} ms of "
        "motion",
        values={f"ahead_{1000 * r.control_period_s:.0f}_ms_mm": r.ahead_mm for r in blends},
        holds=rising,
        note="The filter's parameters are those of 100 ms throughout: with the jerk constant over "
        "a step, the same q lets the state wander less at a shorter step."
        if not rising
        else "The filter's parameters are those of 100 ms throughout.",
    )


def _levels(blends: list[TimingResult], reactives: Mapping[float, TimingResult]) -> Claim:
    fast, slow = blends[0], blends[-1]
    others = [reactives[r.control_period_s] for r in blends]
    holds = fast.rmse_mm < slow.rmse_mm and fast.rmse_mm < others[0].rmse_mm
    return Claim(
        claim="A faster robot would perform better with the proposed technique.",
        figure="timing",
        paper="an expectation",
        criterion="RMSE with prediction at the shortest period is below that at the longest, and "
        "below that without prediction at the same period; latency as in Table I",
        measured=f"with prediction {_told(blends, 'rmse_mm')} mm; without "
        f"{_told(others, 'rmse_mm')} mm",
        values={f"blend_{1000 * r.control_period_s:.0f}_ms_mm": r.rmse_mm for r in blends}
        | {f"reactive_{1000 * r.control_period_s:.0f}_ms_mm": r.rmse_mm for r in others},
        holds=holds,
        note="One prediction is one step ahead of the sample: at a shorter period it covers less "
        f"of the latency of {1000 * fast.latency_s:.0f} ms, so that prediction itself gains less "
        "although the robot answers sooner.",
    )
