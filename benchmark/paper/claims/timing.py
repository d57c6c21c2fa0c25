"""Claims about a faster robot (section V.A)."""

import itertools
from collections.abc import Mapping, Sequence

from ...runner import Run
from ..evidence import Timing
from ..timing import TimingResult, at_papers_latency, timing_results
from .claim import Claim


def timing_claims(runs: Mapping[Timing, Run]) -> list[Claim]:
    """Return the claims about control period and latency."""
    results = timing_results(runs)
    blends, reactives = (at_papers_latency(results, policy) for policy in ("blend", "reactive"))
    return [_next_sample(blends), _same_time(blends), _performs(blends, reactives)]


def _next_sample(blends: Sequence[TimingResult]) -> Claim:
    return Claim(
        claim="With a faster robot, more samples a second would improve the predictions (of the "
        "next sample).",
        figure="timing",
        paper="an expectation",
        criterion="the rms error one step ahead falls with every shorter period, in mm and as time",
        measured=f"{_told(blends, 'one_step_mm')} mm, which is "
        f"{_told(blends, 'one_step_ms', '.1f')} ms of motion",
        values=_values(blends, "one_step_mm"),
        holds=_rising(blends, "one_step_mm") and _rising(blends, "one_step_ms"),
        note="The next sample is nearer, which alone makes it easier; see the next claim.",
    )


def _same_time(blends: Sequence[TimingResult]) -> Claim:
    retuned = _rising(blends, "ahead_retuned_mm")
    return Claim(
        claim="More samples a second would improve the predictions (of the same 100 ms ahead).",
        figure="timing",
        paper="an expectation",
        criterion="the rms error 100 ms ahead falls with every shorter period",
        measured=f"{_told(blends, 'ahead_mm')} mm",
        values=_values(blends, "ahead_mm") | _values(blends, "ahead_retuned_mm"),
        holds=_rising(blends, "ahead_mm"),
        note="The filter keeps its parameters, but q is the variance of a jerk that is constant "
        "over a step: the same q at a shorter step means less process noise a second, and a filter "
        "that believes its own model more. With q times the period kept, computed offline on the "
        f"same samples, the errors are {_told(blends, 'ahead_retuned_mm')} mm: more samples "
        + ("do help a filter that is tuned for them." if retuned else "still do not help."),
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
        "lower and the share of the error that prediction takes away is larger",
        measured=f"with prediction {_told(blends, 'rmse_mm')} mm; without "
        f"{_told(reactives, 'rmse_mm')} mm; prediction takes away {gains[0]:.0%} at the shortest "
        f"and {gains[-1]:.0%} at the longest period",
        values=_values(blends, "rmse_mm") | {"gain_fast": gains[0], "gain_slow": gains[-1]},
        holds=fast.rmse_mm < slow.rmse_mm and gains[0] > gains[-1],
        note="The framework predicts one step ahead of the sample, and does not make up for the "
        f"sample's age. At {1000 * fast.control_period_s:.0f} ms a step that is "
        f"{1000 * fast.control_period_s:.0f} of the {1000 * fast.latency_s:.0f} ms by which the "
        "sample is old: the shorter the step, the less there is in a prediction.",
    )


def _told(results: Sequence[TimingResult], attribute: str, digits: str = ".2f") -> str:
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
