"""The criteria of admission, each with a figure, its 95 % interval, a bar and a verdict."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final, Literal

import numpy as np
from colift.benchmark.admission.evidence import Evidence, without_pair
from colift.benchmark.admission.jackknife import ratio_interval, spread
from colift.benchmark.admission.played import Played
from colift.benchmark.admission.swaps import FAMILY, swaps
from colift.benchmark.admission.variance import VarianceShares, variance_shares
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.benchmark.statistics import FloatArray, Interval

PARTNER: Final = 1.5
"""Least error of a robot that acts alone, over that of the best known: one that heeds its partner
leaves at most two thirds of it."""

INTERACTION: Final = 0.2
"""Least share of the interaction of policy and person in the variance between people."""

IDLE: Final = 2.0
"""Least error of a robot that does nothing, as a multiple of two people's."""

COORDINATION: Final = "the robot needs its partner"
ADAPTATION: Final = "the robot needs to know the person"
INFERENCE: Final = "the robot needs to find out what it is not told"
"""What a suite can claim."""


Verdict = Literal["passed", "failed", "undecided", "not compared"]


@dataclass(frozen=True, kw_only=True)
class Criterion:
    """One criterion, as measured."""

    letter: str
    claim: str
    """The claim that it tests."""
    what: str
    """The condition in words."""
    bar: str
    """The limit of the figure, in words."""
    detail: str
    """The underlying figures, in words."""
    figure: float | None = None
    """The measured figure; None if it was not compared."""
    ci95: Interval | None = None
    """Its 95 % interval; None if it was not compared."""
    passed: bool | None = None
    """Whether it holds: the whole interval is within the limit, or as for :func:`.ratio_criterion`;
    None if it was not compared."""
    hangs_on: tuple[str, ...] = ()
    """The policies, people and pairs that decide it: without any one of them, it has the opposite
    result."""

    @property
    def verdict(self) -> Verdict:
        """The verdict, which no single policy or person decides."""
        if self.passed is None:
            return "not compared"
        if self.hangs_on:
            return "undecided"
        return "passed" if self.passed else "failed"

    @property
    def doubt(self) -> str:
        """Why it is undecided, in words; empty if it is not."""
        if not self.hangs_on:
            return ""
        opposite = "fails" if self.passed else "passes"
        *others, last = self.hangs_on
        names = f"any one of {', '.join(others)} and {last}" if others else last
        return f"it {opposite} without {names}"


def needs_partner(evidence: Evidence) -> Criterion:
    """Return whether robots that are blind to the partner are worse than the best known one."""
    means = evidence.played.part(evidence.causal)
    blind = [name for name in evidence.causal if name in evidence.alone]

    def best(played: Played, names: list[str]) -> str:
        found = played.typical
        return min(names, key=lambda name: found[name])

    def ratio(played: Played) -> float:
        found = played.typical
        return found[best(played, blind)] / min(found.values())

    stated = Criterion(
        letter="a",
        claim=COORDINATION,
        what="acting alone costs: best robot that is blind to the partner, over best known",
        bar=f"at least {PARTNER:g}",
        detail="no robot that is blind to the partner was played",
    )
    if not blind:
        return stated
    figure, found = ratio(means), means.typical
    alone, known = best(means, blind), best(means, list(means.players))
    low, high = ratio_interval(figure, _without_people(means, ratio))
    return replace(
        stated,
        figure=figure,
        ci95=(low, high),
        passed=low >= PARTNER,
        detail=f"{alone} {found[alone]:.2f} mm, {known} {found[known]:.2f} mm",
    )


def interaction(evidence: Evidence) -> Criterion:
    """Return whether the best policy depends on the person; policies count whatever their origin.

    The interval is that of other people and other policies. The interaction itself must also be
    beyond its noise, since a share of nothing can be anything.
    """
    played = evidence.played.part(evidence.policies)
    shares = variance_shares(played.errors)
    left = [
        [variance_shares(np.delete(played.errors, i, axis)) for i in range(count)]
        for axis, count in enumerate(played.errors.shape[:2])
        if count > 2
    ]
    share = spread(*([each.between_people for each in some] for some in left))
    itself = spread(*([each.variance for each in some] for some in left))
    low, high = (min(max(end, 0.0), 1.0) for end in share.around(shares.between_people))
    least, most = itself.around(shares.variance)
    detail = _shares_in_words(shares, len(played.players), len(played.people))
    if low >= INTERACTION and least <= 0.0:
        detail += (
            f"; the interaction itself, {shares.variance:.3f} [{least:.3f}, {most:.3f}], is not "
            "beyond its noise"
        )
    return Criterion(
        letter="b",
        claim=ADAPTATION,
        what="which policy is good depends on the person: share in the variance between people",
        bar=f"at least {INTERACTION:g}",
        figure=shares.between_people,
        ci95=(low, high),
        passed=low >= INTERACTION and least > 0.0,
        detail=detail,
    )


def rank_changes(evidence: Evidence) -> Criterion:
    """Return whether two policies exist, each better than the other with some people."""
    played = evidence.played.part(evidence.policies + evidence.settings)
    found = swaps(played)
    best = found[0]
    pairs = len(played.players) * (len(played.players) - 1) // 2
    count = sum(swap.p <= FAMILY for swap in found)
    leads = ", ".join(
        f"{lead.policy} with {lead.people} ({lead.ratio:.2f} [{lead.ci95[0]:.2f}, "
        f"{lead.ci95[1]:.2f}])"
        for lead in best.leads
    )
    return Criterion(
        letter="c",
        claim=ADAPTATION,
        what="two policies exist, each better with some people: error of the worse, over the other",
        bar="above 1",
        figure=best.least.ratio,
        ci95=best.least.ci95,
        passed=best.least.ci95[0] > 1.0,
        detail=f"{count} of {pairs} pairs; clearest: {leads} of {len(played.people)} people; the "
        "intervals hold for all pairs together",
    )


def conventions(evidence: Evidence) -> Criterion:
    """Return whether pairs that were trained apart do better with their own partners."""
    stated = Criterion(
        letter="d",
        claim=COORDINATION,
        what="pairs that learned apart fail with each other: error across, over own",
        bar="above 1",
        detail="no pair was trained for this test",
    )
    if evidence.pairs is None:
        return stated

    def own_across(errors: FloatArray) -> tuple[float, float]:
        count, own = len(errors), float(errors.trace())
        return own / count, (float(errors.sum()) - own) / (count * (count - 1))

    def ratio(errors: FloatArray) -> float:
        own, across = own_across(errors)
        return across / own

    count = len(evidence.pairs)
    left = [ratio(without_pair(evidence.pairs, i)) for i in range(count)]
    low, high = ratio_interval(ratio(evidence.pairs), left)
    own, across = own_across(evidence.pairs)
    return replace(
        stated,
        figure=across / own,
        ci95=(low, high),
        passed=low > 1.0,
        detail=f"{count} pairs in the twin: {own:.2f} mm with themselves, {across:.2f} mm across",
    )


def like_people(evidence: Evidence) -> Criterion:
    """Return whether two simulated people are in a published interval."""
    stated = Criterion(
        letter="e",
        claim=COORDINATION,
        what="two simulated people are like real ones",
        bar="as published",
        detail=evidence.not_compared,
    )
    compared = evidence.compared
    if compared is None:
        return stated
    published, figure = compared.published, compared.figure
    low, high = spread(compared.without_each).around(figure)
    return replace(
        stated,
        what=f"{stated.what}: {published.what}",
        bar=published.interval,
        figure=figure,
        ci95=(low, high),
        passed=published.low <= low and high <= published.high,
        detail=published.source,
    )


def no_free_ride(evidence: Evidence) -> Criterion:
    """Return whether doing nothing, or dropping the table, costs more than two people do."""
    played = evidence.played.part((evidence.idle, evidence.two_people))

    def ratio(some: Played) -> float:
        return some.typical[evidence.idle] / some.typical[evidence.two_people]

    figure = ratio(played)
    low, high = ratio_interval(figure, _without_people(played, ratio))
    worst = float(played.errors[1].max())
    found = played.typical
    return Criterion(
        letter="f",
        claim=COORDINATION,
        what="nobody earns by standing still or by dropping the table: error of standing still, "
        "over that of two people",
        bar=f"at least {IDLE:g}",
        figure=figure,
        ci95=(low, high),
        passed=low >= IDLE and worst < FAILED_FRAME_MM,
        detail=f"{evidence.idle} {found[evidence.idle]:.1f} mm, two people "
        f"{found[evidence.two_people]:.1f} mm (at most {worst:.0f}), a frame after a drop "
        f"{FAILED_FRAME_MM:.0f} mm",
    )


def _without_people(played: Played, figure: Callable[[Played], float]) -> list[float]:
    """Return a figure without each of the people."""
    return [figure(played.without(person=person)) for person in played.people]


def _shares_in_words(shares: VarianceShares, policies: int, people: int) -> str:
    return (
        f"of all variance: policy {shares.policy:.2f}, person {shares.person:.2f}, interaction "
        f"{shares.interaction:.2f}, of {policies} policies and {people} people, without the noise "
        "of single lifts"
    )
