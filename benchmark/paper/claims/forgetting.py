"""Claims about the forgetting factor (section IV.C)."""

from collections.abc import Mapping, Sequence

import numpy as np

from ...runner import Run
from ..measures import fluctuation
from ..published import FORGETTING
from ..replay import confidence_course, replay
from ..sampled import SampledLift
from ..settling import settling
from ..table_one import errors
from .claim import Claim


def forgetting_claims(
    rests: Sequence[SampledLift], pauses: Sequence[SampledLift], runs: Mapping[float, Run]
) -> list[Claim]:
    """Return the claims from lifts with a rest (offline) and from ordinary lifts by factor."""
    factors = sorted(runs)
    return [_fluctuates(rests, factors), _settles(rests, factors), _good(pauses, runs)]


def _fluctuates(rests: Sequence[SampledLift], factors: Sequence[float]) -> Claim:
    courses = [replay(lift.samples, lift.scenario.control_period).likelihood for lift in rests]
    means = [
        float(np.mean([fluctuation(confidence_course(course, phi)) for course in courses]))
        for phi in factors
    ]
    return Claim(
        claim="A low forgetting factor makes the confidence fluctuate heavily.",
        figure="figure 7",
        paper="in words only",
        criterion="fluctuation (rms change of C from step to step, over a lift) falls with every "
        "step up in φ",
        measured=_listed(factors, means, ".3f"),
        values={f"phi_{phi:.2f}": value for phi, value in zip(factors, means, strict=True)},
        holds=bool(np.all(np.diff(means) < 0)),
        note=f"Mean of {len(rests)} lifts, computed offline.",
    )


def _settles(rests: Sequence[SampledLift], factors: Sequence[float]) -> Claim:
    first, last = (
        [
            float(np.mean([settling(lift, phi, staying=staying) for lift in rests]))
            for phi in factors
        ]
        for staying in (False, True)
    )
    return Claim(
        claim="A high forgetting factor makes the confidence settle very slowly.",
        figure="figure 7",
        paper="in words only",
        criterion="settling (steps from the human's standstill until C first comes within 5 % of "
        "its value at rest) grows with every step up in φ",
        measured=_listed(factors, first, ".1f"),
        values={f"phi_{phi:.2f}": value for phi, value in zip(factors, first, strict=True)},
        holds=bool(np.all(np.diff(first) > 0)),
        note=f"Mean of {len(rests)} lifts. First arrival, because a low φ never stays within 5 %: "
        "the sensor's noise and the sway of a human who stands still take it out again, which is "
        "the fluctuation above. Counted to the "
        f"last departure the steps are {_listed(factors, last, '.0f')}.",
    )


def _good(pauses: Sequence[SampledLift], runs: Mapping[float, Run]) -> Claim:
    means = {phi: float(errors(run.episodes).mean()) for phi, run in sorted(runs.items())}
    best = min(means, key=lambda phi: means[phi])
    excess = means[FORGETTING] / means[best] - 1
    smoothness = [float(np.nanmean(_sparc(run))) for _, run in sorted(runs.items())]
    braking = [float(np.mean([_after_braking(lift, phi) for lift in pauses])) for phi in means]
    return Claim(
        claim="0.45 is a good trade-off between smooth variation and adaptability.",
        figure="figure 7",
        paper="0.45",
        criterion="the mean RMSE of lifts with 0.45 is within 2 % of that of the best factor",
        measured=f"{_listed(list(means), list(means.values()), '.2f')} mm; best: {best:.2f}, "
        f"0.45 is {100 * excess:.1f} % above",
        values={f"phi_{phi:.2f}_mm": value for phi, value in means.items()},
        holds=excess <= 0.02,
        note=f"{len(runs[FORGETTING].episodes)} lifts of Table I for each factor, in the world. "
        f"SPARC {_listed(list(means), smoothness, '.2f')}. "
        + ("What keeps the confidence up lowers the error of these lifts. " * (best > FORGETTING))
        + "What a high factor costs shows in irregular ones: in the fifth step after the human "
        "began to brake for a pause, when the prediction is wrong, C is "
        f"{_listed(list(means), braking, '.2f')} (offline, on figure 6's lifts).",
    )


def _sparc(run: Run) -> list[float]:
    return [episode.scores.sparc for episode in run.episodes]


def _after_braking(lift: SampledLift, forgetting: float) -> float:
    """Return the confidence in the fifth step that shows the braking, offline."""
    course = confidence_course(
        replay(lift.samples, lift.scenario.control_period).likelihood, forgetting
    )
    return float(course[lift.step_showing(lift.event("brake")) + 4])


def _listed(factors: Sequence[float], values: Sequence[float], digits: str) -> str:
    return ", ".join(
        f"{phi:.2f}: {format(value, digits)}" for phi, value in zip(factors, values, strict=True)
    )
