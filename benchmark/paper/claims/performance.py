"""Claims about the performance of the team beside Table I (sections IV.E and V.A)."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ...episode import Episode
from ...metrics import stroke_smoothness
from ...smoothness import sparc
from ...statistics import paired_permutation_p, stratified_bootstrap
from ..evidence import Evidence
from ..sampled import SampledLift, sampled_lifts
from ..table_one import errors
from .claim import Claim, p_text
from .confidence import moving_confidence

Series = NDArray[np.float64]


def performance_claims(evidence: Evidence) -> list[Claim]:
    """Return the claims about absolute error, smoothness and the human's part in it."""
    return [_absolute(evidence), _smoother(evidence), _lowering(evidence), *_jerky(evidence)]


def _absolute(evidence: Evidence) -> Claim:
    without, with_it = (
        np.array([episode.scores.abs_error_mm for episode in run.episodes])
        for run in (evidence.reactive, evidence.blend)
    )
    p = paired_permutation_p(with_it, without)
    return Claim(
        claim="The absolute error is lower with prediction.",
        figure="figure 8",
        paper="one pair of lifts, drawn",
        criterion="mean of eq. 10 lower, paired p < 0.01",
        measured=f"{with_it.mean():.0f} mm against {without.mean():.0f} mm, summed over the frames "
        f"of a lift ({p_text(p)}); lower in {np.mean(with_it < without):.0%} of the lifts",
        values={"with_mm": float(with_it.mean()), "without_mm": float(without.mean()), "p": p},
        holds=bool(with_it.mean() < without.mean() and p < 0.01),
    )


def _smoother(evidence: Evidence) -> Claim:
    with_it, without = _scores(evidence.blend.episodes), _scores(evidence.reactive.episodes)
    a, b = _both(with_it, without)
    p = paired_permutation_p(a, b)
    jerks = [
        np.nanmean([episode.scores.ldlj for episode in run.episodes])
        for run in (evidence.blend, evidence.reactive)
    ]
    return Claim(
        claim="The motion with prediction is smoother than without.",
        figure="figure 8",
        paper="one pair of lifts, drawn",
        criterion="mean SPARC of the robot's end higher (closer to 0), paired p < 0.01",
        measured=f"SPARC {a.mean():.2f} against {b.mean():.2f} ({p_text(p)}), {a.size} lifts; "
        f"LDLJ {jerks[0]:.1f} against {jerks[1]:.1f}",
        values={"with": float(a.mean()), "without": float(b.mean()), "p": p},
        holds=bool(a.mean() > b.mean() and p < 0.01),
    )


def _lowering(evidence: Evidence) -> Claim:
    ups, downs = np.array([stroke_scores(lift) for lift in evidence.lifts]).T
    up, down = _both(ups, downs)
    p = paired_permutation_p(down, up)
    better = bool(down.mean() > up.mean())
    return Claim(
        claim="With prediction, the motion is smoother while lowering than while lifting.",
        figure="figure 8",
        paper="one lift, drawn; put down to the arm's jerks against gravity",
        criterion="mean SPARC of the robot's end higher in the lowering, paired p < 0.01",
        measured=f"SPARC {down.mean():.2f} lowering, {up.mean():.2f} lifting ({p_text(p)})",
        values={"lowering": float(down.mean()), "lifting": float(up.mean()), "p": p},
        holds=better and p < 0.01,
        note="The paper's reason, an arm that jerks when it works against gravity, is not in the "
        "simulation: its servos carry the load alike in both directions, and only the human's own "
        "strokes differ up and down. What difference there is comes from them.",
    )


def stroke_scores(lift: SampledLift) -> tuple[float, float]:
    """Return the SPARC of the robot's end in the first and in the last stroke of a lift."""
    trace, strokes = lift.episode.trace, lift.plan.strokes
    ends = (strokes[1][0] if len(strokes) > 1 else None, None)
    first, last = (
        stroke_smoothness(trace.robot_end[:end], trace.human_end[:end], [stroke], metric=sparc)
        for stroke, end in zip((strokes[0], strokes[-1]), ends, strict=True)
    )
    return first, last


def _jerky(evidence: Evidence) -> list[Claim]:
    jerky = sampled_lifts(evidence.jerky_blend)
    smooth_c, jerky_c = (
        float(moving_confidence(lifts).mean()) for lifts in (evidence.lifts, jerky)
    )
    runs = (evidence.blend, evidence.jerky_blend, evidence.reactive, evidence.jerky_reactive)
    smooth, rough, smooth_reactive, rough_reactive = (
        float(errors(run.episodes).mean()) for run in runs
    )
    (_, high), (low, _) = (
        stratified_bootstrap(errors(run.episodes), [episode.subject for episode in run.episodes])
        for run in runs[:2]
    )
    ratios = smooth / smooth_reactive, rough / rough_reactive
    better = high < low
    return [
        Claim(
            claim="If the human's motion is jerky, the robot cannot estimate it accurately and "
            "leads less.",
            figure="figure 5",
            paper="in words only",
            criterion="mean confidence in motion lower with a jerky than with a smooth human",
            measured=f"{jerky_c:.2f} jerky, {smooth_c:.2f} smooth",
            values={"jerky": jerky_c, "smooth": smooth_c},
            holds=jerky_c < smooth_c,
        ),
        Claim(
            claim="A smoother human gives better results.",
            figure="Table I",
            paper="in words only",
            criterion="mean RMSE with prediction lower with a smooth than with a jerky human, 95 % "
            "intervals apart",
            measured=f"{smooth:.2f} mm smooth, {rough:.2f} mm jerky; without prediction "
            f"{smooth_reactive:.2f} and {rough_reactive:.2f} mm",
            values={"smooth_mm": smooth, "jerky_mm": rough, "smooth_reactive_mm": smooth_reactive}
            | {"jerky_reactive_mm": rough_reactive},
            holds=better,
            note=f"With / without prediction is {ratios[0]:.2f} with a smooth and {ratios[1]:.2f} "
            "with a jerky human: "
            + (
                "prediction also gains less from a jerky one."
                if ratios[1] > ratios[0]
                else "the loss is not one of prediction."
            ),
        ),
    ]


def _scores(episodes: Sequence[Episode]) -> Series:
    return np.array([episode.scores.sparc for episode in episodes])


def _both(a: Series, b: Series) -> tuple[Series, Series]:
    """Return the pairs that have both values."""
    present = ~(np.isnan(a) | np.isnan(b))
    return a[present], b[present]
