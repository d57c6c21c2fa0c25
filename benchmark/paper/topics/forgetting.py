"""The forgetting factor: claims, figure 7 (section IV.C)."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
from colift.benchmark.execution.runner import Run
from colift.benchmark.paper.exhibits import STEPS, Claim, Exhibit, shade
from colift.benchmark.paper.refilter import confidence_trajectory
from colift.benchmark.paper.table_one import FORGETTING, FORGETTING_FACTORS, errors
from colift.benchmark.paper.watched import SampledLift, rms
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.panels import panels
from colift.benchmark.rendering.style import CONFIDENCE, HUMAN
from numpy.typing import ArrayLike

SETTLED: Final = 0.05
"""A profile has settled within this fraction of its resting value."""


def forgetting_claims(
    rests: Sequence[SampledLift], pauses: Sequence[SampledLift], runs: Mapping[float, Run]
) -> list[Claim]:
    """Return the claims from lifts with a rest (offline) and from ordinary lifts by factor."""
    factors = sorted(runs)
    return [_fluctuates(rests, factors), _settles(rests, factors), _good(pauses, runs)]


def _fluctuates(rests: Sequence[SampledLift], factors: Sequence[float]) -> Claim:
    likelihoods = [lift.refiltered.likelihood for lift in rests]
    means = [
        float(
            np.mean([fluctuation(confidence_trajectory(profile, phi)) for profile in likelihoods])
        )
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
    return [episode.scores["sparc"] for episode in run.episodes]


def _after_braking(lift: SampledLift, forgetting: float) -> float:
    """Return the confidence in the fifth step that shows the braking, offline."""
    profile = confidence_trajectory(lift.refiltered.likelihood, forgetting)
    return float(profile[lift.step_showing(lift.event("brake")) + 4])


def _listed(factors: Sequence[float], values: Sequence[float], digits: str) -> str:
    return ", ".join(
        f"{phi:.2f}: {format(value, digits)}" for phi, value in zip(factors, values, strict=True)
    )


def forgetting_exhibit(lift: SampledLift, layout: Layout) -> Exhibit:
    """Return figure 7 from one lift with a long pause."""
    start, stop = (lift.step_showing(lift.event(event)) for event in ("pause", "resume"))
    likelihoods = lift.refiltered.likelihood
    figure, rows = panels(
        layout,
        ["position [mm]", *(f"φ = {phi:.2f}" for phi in FORGETTING_FACTORS)],
        [1.3, *[0.8] * len(FORGETTING_FACTORS)],
        x_label=STEPS,
    )
    steps = np.arange(len(lift.samples))
    shade(rows[0][0], [(start, stop)])
    rows[0][0].plot(steps, 1000 * lift.samples, color=HUMAN, lw=2.0)
    columns: dict[str, Sequence[float]] = {
        "step": steps.tolist(),
        "observed_position_m": lift.samples.tolist(),
        "likelihood": likelihoods.tolist(),
    }
    changes: list[float] = []
    for (axes,), phi in zip(rows[1:], FORGETTING_FACTORS, strict=True):
        profile = confidence_trajectory(likelihoods, phi)
        columns[f"confidence_phi_{phi:.2f}"] = profile.tolist()
        shade(axes, [(start, stop)])
        axes.plot(steps, profile, color=CONFIDENCE, lw=1.8)
        axes.set_ylim(-0.05, 1.08)
        axes.annotate(f"settles in {settling(lift, phi)} steps", (stop - 1, 0.12), ha="right")
        changes.append(fluctuation(profile))
    return Exhibit(
        name="figure-7",
        title="Figure 7. Effect of the forgetting factor on confidence",
        caption=f"Subject {lift.episode.subject}, seed {lift.episode.seed}: one recorded lift with "
        "a long rest half way (shaded), its confidence computed offline for each forgetting "
        "factor. A low one follows every likelihood; a high one takes seconds to notice anything. "
        "From one step to the next C changes by (root mean square over the lift) "
        f"{_listed(FORGETTING_FACTORS, changes, '.3f')}. Settling is the time from the human's "
        "standstill until C first comes within 5 % of its value at rest.",
        figure=figure,
        columns=columns,
    )


def settling(lift: SampledLift, forgetting: float, *, staying: bool = False) -> int:
    """Return the number of steps of the human's pause after which the confidence has settled.

    Computed offline from the lift's samples; see :func:`.settling_steps`.

    Parameters
    ----------
    lift
        A lift with a long pause.
    forgetting
        phi of eq. 7.
    staying
        Whether to wait for the last departure, noise included, instead of the first arrival.
    """
    profile = confidence_trajectory(lift.refiltered.likelihood, forgetting)
    start, stop = (lift.step_showing(lift.event(event)) for event in ("pause", "resume"))
    return settling_steps(profile[start:stop], staying=staying)


def fluctuation(profile: ArrayLike) -> float:
    """Return the root mean square of the changes from step to step.

    Parameters
    ----------
    profile
        Values, one per step, at least two.
    """
    return rms(np.diff(np.asarray(profile, dtype=np.float64)))


def settling_steps(profile: ArrayLike, *, staying: bool = False) -> int:
    """Return the number of steps after which a profile has come to rest.

    The resting value is the mean of the last quarter of the profile.

    Parameters
    ----------
    profile
        Values, from the step in which the cause of the change ended.
    staying
        Whether to count up to the last time that the profile is further than ``SETTLED`` from its
        resting value, noise included, instead of to its first arrival.

    Returns
    -------
    int
        Steps: 0 if the first value is already there.
    """
    x = np.asarray(profile, dtype=np.float64)
    resting = x[-max(len(x) // 4, 1) :].mean()
    away = np.abs(x - resting) > SETTLED * abs(resting)
    if staying:
        return int(np.flatnonzero(away)[-1]) + 1 if away.any() else 0
    return int(np.argmin(away)) if not away.all() else len(x)
