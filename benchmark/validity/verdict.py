"""The verdict on suites, computed from the lifts of a source."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from colift.benchmark.comparison.formatting import p_value
from colift.benchmark.validity.prediction import SuitePrediction
from colift.benchmark.validity.quantity import Quantity
from colift.benchmark.validity.scores import Scores
from colift.benchmark.validity.winner import Rival, rivals

Judgement = Literal["right", "open", "doubtful", "misleading"]
"""``right``: the suite's best policy is significantly the best on the source, too. ``open``: it
leads there, but not significantly. ``doubtful``: it does not lead there. ``misleading``: another
policy is significantly better there."""


@dataclass(frozen=True, kw_only=True)
class SuiteVerdict:
    """The verdict of a source's lifts on the first place of a suite."""

    source: str
    lifts: int
    """Lifts of the source."""
    policy: str
    """The suite's best policy."""
    place: int
    """Its place on the source, 1 for the best."""
    rmse_mm: float
    """Its mean RMSE there [mm]."""
    rivals: tuple[Rival, ...]
    """The other policies on the source, the best first."""

    @property
    def judgement(self) -> Judgement:
        """The verdict in one word."""
        if self.beaten_by:
            return "misleading"
        if any(rival.behind_mm.value < 0.0 for rival in self.rivals):
            return "doubtful"
        return "right" if all(rival.worse for rival in self.rivals) else "open"

    @property
    def beaten_by(self) -> tuple[Rival, ...]:
        """The policies that are significantly better on the source, the best first."""
        return tuple(rival for rival in self.rivals if rival.better)

    @property
    def rival(self) -> Rival:
        """The best other policy on the source; of the significantly better ones, if any."""
        return next(iter(self.beaten_by), self.rivals[0])

    @property
    def behind_mm(self) -> Quantity:
        """Its RMSE on the source minus the rival's [mm]: positive if the rival is better."""
        behind = self.rival.behind_mm
        return Quantity(value=-behind.value, low=-behind.high, high=-behind.low)

    def text(self, suites: Sequence[str]) -> str:
        """Return the verdict on suites with this best policy in a sentence."""
        names, one, rival = _listed(suites), len(suites) == 1, self.rival
        its = f"{'its' if one else 'their'} best policy, {self.policy},"
        match self.judgement:
            case "misleading":
                return (
                    f"{names} {'is' if one else 'are'} misleading on {self.source}: {its} is "
                    f"beaten by {_first(self.beaten_by)}, {_mm(rival.rmse_mm)} against "
                    f"{_mm(self.rmse_mm)} mm ({self._certainty(rival)})."
                )
            case "doubtful":
                ahead = [each for each in self.rivals if each.behind_mm.value < 0.0]
                return (
                    f"{names} {'is' if one else 'are'} in doubt on {self.source}: {its} is behind "
                    f"{_first(ahead)}, {_mm(self.rmse_mm)} against {_mm(rival.rmse_mm)} mm, though "
                    f"{self.lifts} lifts do not prove it ({self._certainty(rival)})."
                )
            case "open":
                level = [each for each in self.rivals if not each.worse]
                return (
                    f"{names} may be right on {self.source}: {its} leads with "
                    f"{_mm(self.rmse_mm)} mm, but {self.lifts} lifts do not separate it from "
                    f"{_first(level)}, {_mm(level[0].rmse_mm)} mm ({self._certainty(level[0])})."
                )
            case "right":
                return (
                    f"{names} {'is' if one else 'are'} right about the best policy on "
                    f"{self.source}: {self.policy}, {_mm(self.rmse_mm)} mm; {rival.name} is next, "
                    f"{_mm(rival.rmse_mm)} mm ({self._certainty(rival)})."
                )

    def _certainty(self, rival: Rival) -> str:
        """Return the share of resamples in which the leading policy is better, and the p value."""
        ahead = rival.behind_mm.value < 0.0
        name, share = (
            (rival.name, rival.better_share) if ahead else (self.policy, 1.0 - rival.better_share)
        )
        p = p_value(rival.p)
        equals = "p " if p.startswith("<") else "p = "
        return f"{name} better in {share:.0%} of resamples, {equals}{p}"


def judge(source: Scores, suite: Scores) -> SuiteVerdict:
    """Return the verdict on a suite, from the scores of the same policies on a source."""
    policy = suite.order()[0]
    return SuiteVerdict(
        source=source.name,
        lifts=source.lifts,
        policy=policy,
        place=source.place(policy),
        rmse_mm=source.mean(policy),
        rivals=rivals(source, policy),
    )


def order_text(suite: str, prediction: SuitePrediction) -> str:
    """Return a sentence if a suite's order is not shown to hold on a source; else nothing."""
    found = prediction.spearman
    if found.low > 0.0:
        return ""
    says = "does not hold" if found.high <= 0.0 else "is not shown to hold"
    return (
        f"The order of {suite} {says} there (Spearman {found.value:.2f}, "
        f"{found.low:.2f} to {found.high:.2f})."
    )


def people_text(source: str, suite: str, prediction: SuitePrediction) -> str:
    """Return a sentence on policies on the other side of two people; empty if there are none."""
    sides = (("More", "less", prediction.fall_behind), ("Less", "more", prediction.overtake))
    return " ".join(
        f"{on_suite} level than two people on {suite}, {there} level on {source}: {_listed(names)}."
        for on_suite, there, names in sides
        if names
    )


def _first(some: Sequence[Rival]) -> str:
    """Return the first of some rivals, and the number of others."""
    return some[0].name + (f" and {len(some) - 1} more" if len(some) > 1 else "")


def _listed(names: Sequence[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


def _mm(value: float) -> str:
    return f"{value:.2f}" if value < 10.0 else f"{value:.1f}"
