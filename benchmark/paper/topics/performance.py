"""Performance with and without prediction, and of two people: claims, figures 8 and 9."""

from collections.abc import Mapping, Sequence

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metrics import stroke_smoothness
from colift.benchmark.episode.smoothness import sparc
from colift.benchmark.paper.evidence import Evidence
from colift.benchmark.paper.exhibits import Claim, Exhibit, p_value_text
from colift.benchmark.paper.table_one import errors, single_lifts
from colift.benchmark.paper.topics.confidence import moving_confidence
from colift.benchmark.paper.watched import SampledLift, sampled_lifts
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.panels import legend, panels
from colift.benchmark.rendering.style import FAINT, HUMAN, ROBOT, ROBOT_DASHES
from colift.benchmark.statistics import Units, mean_of, paired_permutation_p
from matplotlib.figure import Figure
from numpy.typing import NDArray

Series = NDArray[np.float64]


def performance_claims(evidence: Evidence) -> list[Claim]:
    """Return the claims about absolute error, smoothness and the influence of the human."""
    return [_absolute(evidence), _smoother(evidence), _lowering(evidence), *_jerky(evidence)]


def _absolute(evidence: Evidence) -> Claim:
    without, with_it = (
        np.array([episode.scores["abs_error_mm"] for episode in run.episodes])
        for run in (evidence.reactive, evidence.blend)
    )
    p = paired_permutation_p(with_it, without, single_lifts(with_it))
    return Claim(
        claim="The absolute error is lower with prediction.",
        figure="figure 8",
        paper="one pair of lifts, drawn",
        criterion="mean of eq. 10 lower, paired p < 0.01",
        measured=f"{with_it.mean():.0f} mm against {without.mean():.0f} mm, summed over the frames "
        f"of a lift ({p_value_text(p)}); lower in {np.mean(with_it < without):.0%} of the lifts",
        values={"with_mm": float(with_it.mean()), "without_mm": float(without.mean()), "p": p},
        holds=bool(with_it.mean() < without.mean() and p < 0.01),
    )


def _smoother(evidence: Evidence) -> Claim:
    with_it, without = _scores(evidence.blend.episodes), _scores(evidence.reactive.episodes)
    a, b = _both(with_it, without)
    p = paired_permutation_p(a, b, single_lifts(a))
    jerks = [
        np.nanmean([episode.scores["ldlj"] for episode in run.episodes])
        for run in (evidence.blend, evidence.reactive)
    ]
    return Claim(
        claim="The motion with prediction is smoother than without.",
        figure="figure 8",
        paper="one pair of lifts, drawn",
        criterion="mean SPARC of the robot's end higher (closer to 0), paired p < 0.01",
        measured=f"SPARC {a.mean():.2f} against {b.mean():.2f} ({p_value_text(p)}), "
        f"{a.size} lifts; LDLJ {jerks[0]:.1f} against {jerks[1]:.1f}",
        values={"with": float(a.mean()), "without": float(b.mean()), "p": p},
        holds=bool(a.mean() > b.mean() and p < 0.01),
    )


def _lowering(evidence: Evidence) -> Claim:
    ups, downs = np.array([stroke_scores(lift) for lift in evidence.lifts]).T
    up, down = _both(ups, downs)
    p = paired_permutation_p(down, up, single_lifts(down))
    better = bool(down.mean() > up.mean())
    return Claim(
        claim="With prediction, the motion is smoother while lowering than while lifting.",
        figure="figure 8",
        paper="one lift, drawn; attributed to the arm's jerks against gravity",
        criterion="mean SPARC of the robot's end higher in the lowering, paired p < 0.01",
        measured=f"SPARC {down.mean():.2f} lowering, {up.mean():.2f} lifting ({p_value_text(p)})",
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
    jerky = sampled_lifts(evidence.jerky_blend, evidence.parameters)
    smooth_c, jerky_c = (
        float(moving_confidence(lifts).mean()) for lifts in (evidence.lifts, jerky)
    )
    runs = (evidence.blend, evidence.jerky_blend, evidence.reactive, evidence.jerky_reactive)
    smooth, rough, smooth_reactive, rough_reactive = (
        float(errors(run.episodes).mean()) for run in runs
    )
    (_, high), (low, _) = (
        mean_of(
            errors(run.episodes), Units.episodes(episode.subject for episode in run.episodes)
        ).ends
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
    return np.array([episode.scores["sparc"] for episode in episodes])


def _both(a: Series, b: Series) -> tuple[Series, Series]:
    """Return the pairs that have both values."""
    present = ~(np.isnan(a) | np.isnan(b))
    return a[present], b[present]


def comparison_exhibit(blend: Episode, reactive: Episode, layout: Layout) -> Exhibit:
    """Return figure 8: the same lift with and without prediction."""
    return Exhibit(
        name="figure-8",
        title="Figure 8. With and without prediction",
        caption=f"Subject {blend.subject}, seed {blend.seed}: the same intention of the human in "
        "both cases. Above the trajectories of the two ends, below the absolute error, whose sum "
        "over the frames is eq. 10.",
        figure=_figure(
            {"case I: with prediction": blend, "case II: without": reactive},
            "robot's end",
            error_limit(blend, reactive),
            layout,
        ),
        columns={**_columns(blend, "with_"), **_columns(reactive, "without_", time=False)},
    )


def error_limit(*episodes: Episode) -> float:
    """Return the end of an axis of the absolute error that covers all episodes [mm]."""
    traces = [episode.trace for episode in episodes]
    return 1050 * max(float(np.abs(t.human_end - t.robot_end).max()) for t in traces)


def human_human_exhibit(episode: Episode, limit: float, layout: Layout) -> Exhibit:
    """Return figure 9: two people, the error's axis up to ``limit`` [mm]."""
    return Exhibit(
        name="figure-9",
        title="Figure 9. Two people",
        caption=f"Subject {episode.subject}, seed {episode.seed}, with a second person at the far "
        "end instead of the robot: the same intention as in figure 8, and the "
        "same scale of the error.",
        figure=_figure({"two people": episode}, "partner's end", limit, layout),
        columns=_columns(episode, ""),
    )


def _figure(cases: Mapping[str, Episode], far: str, limit: float, layout: Layout) -> Figure:
    figure, (upper, lower) = panels(
        layout,
        ["height [mm]", "|Z1 \N{MINUS SIGN} Z2| [mm]"],
        [2.2, 1.4],
        columns=len(cases),
        x_label="time [s]",
        share_x=False,
    )
    for above, below, (name, episode) in zip(upper, lower, cases.items(), strict=True):
        trace, scores = episode.trace, episode.scores
        times = np.arange(1, len(trace.human_end) + 1) * FRAME
        above.plot(times, 1000 * trace.human_end, color=HUMAN, lw=1.8, label="human's end")
        above.plot(times, 1000 * trace.robot_end, color=ROBOT, lw=1.8, ls=ROBOT_DASHES, label=far)
        error = 1000 * np.abs(trace.human_end - trace.robot_end)
        below.fill_between(times, error, color=FAINT, alpha=0.35, lw=0)
        below.plot(times, error, color=FAINT, lw=1.0)
        smoothness = f"{scores['sparc']:.2f}".replace("-", "\N{MINUS SIGN}")
        sum_of = f"sum {scores['abs_error_mm']:.0f} mm"
        below.annotate(sum_of, (1, 1), xycoords="axes fraction", ha="right", va="top")
        legend(above, f"{name}\nRMSE {scores['rmse_mm']:.1f} mm, SPARC {smoothness}")
    for below in lower:
        below.set_ylim(0, 1.3 * limit)
    return figure


def _columns(episode: Episode, prefix: str, *, time: bool = True) -> dict[str, list[float]]:
    trace = episode.trace
    columns = {
        f"{prefix}human_end_m": trace.human_end.tolist(),
        f"{prefix}robot_end_m": trace.robot_end.tolist(),
    }
    if not time:
        return columns
    times = (np.arange(1, len(trace.human_end) + 1) * FRAME).round(2)
    return {"time_s": times.tolist(), **columns}
