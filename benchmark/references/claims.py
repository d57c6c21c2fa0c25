"""The claims about `learned`, measured."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from colift.benchmark.comparison.paired_results import PairedResults
from colift.benchmark.results.baselines import BEST_KNOWN
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import Interval, share_better
from colift.benchmark.suites.catalogue import RECORDED

POLICY: Final = "learned"
RIVALS: Final = ("anticipate", "blend", "reactive")
"""The best policy before `learned`, and the paper's."""

TO_HUMAN_HUMAN: Final = {"smooth": 0.70, "pause": 0.70, "jerky": 1.15, "changing_goal": 0.70}
TO_HUMAN_HUMAN_OVER_ALL: Final = 0.75
"""Largest RMSE over the human-human baseline's, on each behaviour and over all."""

TO_BEST_KNOWN: Final = 1.2
TO_BEST_KNOWN_OVER_ALL: Final = 1.1
"""Largest RMSE over the best known policy's, on each behaviour and over all."""

TO_ANTICIPATE: Final = 1.0
"""Largest RMSE over that of `anticipate`, over all."""

TO_BLEND: Final = 0.35
"""Largest RMSE over that of `blend`, on smooth and on recorded lifts."""

WINS: Final = 0.98
"""Smallest fraction of the recorded lifts in which `learned` is more level than `blend`."""


@dataclass(frozen=True, kw_only=True)
class PolicyClaim:
    """A number and its limit."""

    text: str
    value: float
    ci95: Interval | None
    limit: float
    least: bool = False
    """Whether the limit is the least allowed value; otherwise it is the largest."""
    chance: bool = False
    """Whether a value beyond the limit that may be chance, by its interval, is no objection."""

    @property
    def holds(self) -> bool:
        """Whether the value is within its limit."""
        value = self.value
        if self.chance and self.ci95 is not None:
            value = self.ci95[1] if self.least else self.ci95[0]
        return value >= self.limit if self.least else value <= self.limit


def claims(results: PairedResults) -> tuple[PolicyClaim, ...]:
    """Return the claims, measured on the policy, its rivals and the references.

    The results must have the rivals. A claim about the best known policy is left out where it was
    not played, as on recorded lifts.
    """
    by_name = {policy.name: policy.scores for policy in results.policies}
    mine, anticipate, blend = (by_name[name] for name in (POLICY, "anticipate", "blend"))
    best, human_human = results.references.get(BEST_KNOWN), results.human_human
    found: list[PolicyClaim] = []

    def ratio(text: str, other: ScoreTable, behaviour: str | None, limit: float) -> None:
        of = mine.part(behaviour).against(other.part(behaviour)).ratio
        text = f"RMSE over that of {text}, {behaviour or 'over all'}"
        found.append(PolicyClaim(text=text, value=of.mean, ci95=of.ci95, limit=limit))

    behaviours = dict.fromkeys(behaviour for behaviour, _ in human_human.strata)
    for behaviour in behaviours:
        if behaviour in TO_HUMAN_HUMAN:
            ratio("two people", human_human, behaviour, TO_HUMAN_HUMAN[behaviour])
            if best is not None:
                ratio("the best known policy", best, behaviour, TO_BEST_KNOWN)
        if behaviour in ("smooth", RECORDED):
            ratio("blend", blend, behaviour, TO_BLEND)
        if behaviour == RECORDED:
            found.append(
                PolicyClaim(
                    text="share of the recorded lifts more level than with blend",
                    value=share_better(mine.part(behaviour).rmse_mm, blend.part(behaviour).rmse_mm),
                    ci95=None,
                    limit=WINS,
                    least=True,
                )
            )
    if set(behaviours) == set(TO_HUMAN_HUMAN):
        ratio("two people", human_human, None, TO_HUMAN_HUMAN_OVER_ALL)
        if best is not None:
            ratio("the best known policy", best, None, TO_BEST_KNOWN_OVER_ALL)
    ratio("anticipate", anticipate, None, TO_ANTICIPATE)
    return (*found, *_kinder(by_name))


def _kinder(by_name: Mapping[str, ScoreTable]) -> Iterator[PolicyClaim]:
    """Yield the claims that it moves as smoothly, with no more force at the human's hands."""
    smoothness, force = (
        "SPARC minus that of {}",
        "rms force at the human's hands minus that with {} [N]",
    )
    for metric, text, name in (
        ("sparc", smoothness, "blend"),
        ("sparc", smoothness, "reactive"),
        ("human_force_n", force, "anticipate"),
        ("human_force_n", force, "blend"),
    ):
        difference = by_name[POLICY].against(by_name[name], metric).difference
        yield PolicyClaim(
            text=f"{text.format(name)}, paired",
            value=difference.mean,
            ci95=difference.ci95,
            limit=0.0,
            least=metric == "sparc",
            chance=True,
        )
