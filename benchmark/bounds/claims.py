"""The claims about `learned`, measured."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.benchmark.bounds.causal import CAUSAL_BOUND
from colift.benchmark.comparison.paired_results import PairedResults, PolicyResults
from colift.benchmark.statistics import (
    FloatArray,
    Interval,
    paired_difference,
    ratio_of_means,
    share_better,
)
from colift.benchmark.suites.catalogue import RECORDED

POLICY: Final = "learned"
RIVALS: Final = ("anticipate", "blend", "reactive")
"""The best policy before `learned`, and the paper's."""

TO_HUMAN_HUMAN: Final = {"smooth": 0.70, "pause": 0.70, "jerky": 1.15, "changing_goal": 0.70}
TO_HUMAN_HUMAN_OVER_ALL: Final = 0.75
"""Largest RMSE over the human-human baseline's, on each behaviour and over all."""

TO_BOUND: Final = 1.05
TO_BOUND_OVER_ALL: Final = 1.03
"""Largest RMSE over the causal bound's, on each behaviour and over all."""

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

    @property
    def holds(self) -> bool:
        """Whether the value is within its limit."""
        return self.value >= self.limit if self.least else self.value <= self.limit


def claims(results: PairedResults) -> tuple[PolicyClaim, ...]:
    """Return the claims, measured on the policy, its rivals and the bounds.

    The results must have the causal bound and the rivals; the human-human baseline is always there.
    On recorded lifts neither the human-human baseline nor the bound is a limit: people follow no
    plan.
    """
    by_name = {policy.name: policy for policy in results.policies}
    strata = results.human_human.strata
    behaviours = np.array([behaviour for behaviour, _ in strata])
    mine, anticipate, blend = (
        _values(by_name[name], "rmse_mm") for name in (POLICY, "anticipate", "blend")
    )
    bound, human_human = (
        np.array(other.rmse_mm) for other in (results.bounds[CAUSAL_BOUND], results.human_human)
    )
    found: list[PolicyClaim] = []

    def ratio(text: str, other: FloatArray, chosen: FloatArray, limit: float) -> None:
        some = [stratum for stratum, taken in zip(strata, chosen, strict=True) if taken]
        of = ratio_of_means(mine[chosen], other[chosen], some)
        text = f"RMSE over that of {text}"
        found.append(PolicyClaim(text=text, value=of.mean, ci95=of.ci95, limit=limit))

    everything = np.full(len(strata), True)
    for behaviour in dict.fromkeys(behaviours.tolist()):
        chosen = behaviours == behaviour
        if behaviour in TO_HUMAN_HUMAN:
            ratio(
                f"the human-human baseline, {behaviour}",
                human_human,
                chosen,
                TO_HUMAN_HUMAN[behaviour],
            )
            ratio(f"the causal bound, {behaviour}", bound, chosen, TO_BOUND)
        if behaviour in ("smooth", RECORDED):
            ratio(f"blend, {behaviour}", blend, chosen, TO_BLEND)
        if behaviour == RECORDED:
            found.append(
                PolicyClaim(
                    text="share of the recorded lifts more level than with blend",
                    value=share_better(mine[chosen], blend[chosen]),
                    ci95=None,
                    limit=WINS,
                    least=True,
                )
            )
    if set(behaviours.tolist()) == set(TO_HUMAN_HUMAN):
        ratio(
            "the human-human baseline, over all", human_human, everything, TO_HUMAN_HUMAN_OVER_ALL
        )
        ratio("the causal bound, over all", bound, everything, TO_BOUND_OVER_ALL)
    ratio("anticipate, over all", anticipate, everything, TO_ANTICIPATE)
    return (*found, *_kinder(by_name, results))


def _kinder(by_name: dict[str, PolicyResults], results: PairedResults) -> Iterator[PolicyClaim]:
    """Yield the claims that it moves more smoothly, with no more force at the human's hands."""
    for name in ("blend", "reactive"):
        smoother = [_values(by_name[other], "sparc") for other in (POLICY, name)]
        moved = ~(np.isnan(smoother[0]) | np.isnan(smoother[1]))
        strata = [
            stratum
            for stratum, taken in zip(results.human_human.strata, moved, strict=True)
            if taken
        ]
        difference = paired_difference(smoother[0][moved], smoother[1][moved], strata)
        yield PolicyClaim(
            text=f"SPARC minus that of {name}, paired",
            value=difference.mean,
            ci95=difference.ci95,
            limit=0.0,
            least=True,
        )
    for name in ("anticipate", "blend"):
        force = [_values(by_name[other], "human_force_n") for other in (POLICY, name)]
        difference = paired_difference(force[0], force[1], results.human_human.strata)
        yield PolicyClaim(
            text=f"rms force at the human's hands minus that with {name} [N], paired",
            value=difference.mean,
            ci95=difference.ci95,
            limit=0.0,
        )


def _values(policy: PolicyResults, metric: str) -> FloatArray:
    return np.array(policy.scores.values[metric])
