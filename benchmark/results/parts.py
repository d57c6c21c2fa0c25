"""Strengths and weaknesses: a run part by part, each beside two people on the same lifts."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from colift.benchmark.results.strata import (
    Spread,
    StratumScore,
    human_human_mean,
    mean_of_strata,
    spread_over_people,
    vs_human_mean,
)
from colift.benchmark.statistics import Estimate


@dataclass(frozen=True, kw_only=True)
class Part:
    """The lifts of a behaviour, or all of them."""

    behaviour: str | None
    """None: all of them."""

    def of(self, strata: Iterable[StratumScore]) -> list[StratumScore]:
        """Return the strata that belong to it."""
        return [each for each in strata if self.behaviour in (None, each.behaviour)]

    @property
    def whole(self) -> bool:
        """Whether it is all lifts."""
        return self.behaviour is None


def parts_of(strata: Sequence[StratumScore]) -> tuple[Part, ...]:
    """Return all lifts, then each behaviour."""
    behaviours = dict.fromkeys(stratum.behaviour for stratum in strata)
    return tuple(Part(behaviour=each) for each in (None, *behaviours))


@dataclass(frozen=True, kw_only=True)
class PartScore:
    """The scores of a policy on a part of its lifts, beside those of others."""

    part: Part
    episodes: int
    failed: int
    rmse_mm: Estimate
    human_human_mm: float | None
    """The human-human baseline's mean RMSE [mm]."""
    ratio: float | None
    """The RMSE over that of two people; see :func:`.vs_human_mean`."""
    other_mm: float | None
    """The mean RMSE of another policy [mm], if there is one."""
    spread: Spread | None
    """How the RMSE differs from person to person; None without lifts."""

    @property
    def marks(self) -> tuple[float, ...]:
        """The means of others [mm] that a picture of this one shows."""
        return tuple(mm for mm in (self.human_human_mm, self.other_mm) if mm is not None)


def part_scores(
    strata: Sequence[StratumScore],
    error: Callable[[Part], Estimate],
    others: Sequence[StratumScore] = (),
) -> tuple[PartScore, ...]:
    """Return the scores on all lifts, then on each behaviour.

    Parameters
    ----------
    strata
        The policy's strata.
    error
        Returns the policy's mean RMSE on a part, with its interval.
    others
        The strata of another policy on the same lifts, if there is one.
    """
    found = []
    for part in parts_of(strata):
        some = part.of(strata)
        found.append(
            PartScore(
                part=part,
                episodes=sum(stratum.episodes for stratum in some),
                failed=sum(stratum.failed for stratum in some),
                rmse_mm=error(part),
                human_human_mm=human_human_mean(some),
                ratio=vs_human_mean(some),
                other_mm=mean_of_strata(part.of(others)).mean,
                spread=spread_over_people(some) if some else None,
            )
        )
    return tuple(found)
