"""Published figures of two people, as references for the simulated pair of a task."""

import dataclasses
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.baselines import human_human_run
from colift.benchmark.statistics import Units, paired_difference
from colift.benchmark.tasks.agree.task import Agree
from colift.benchmark.tasks.intent.task import Intent
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class Published:
    """A published figure of two people, and its counterpart in the human-human baseline."""

    what: str
    """The figure in words."""
    unit: str
    low: float
    high: float
    """The interval that was published, or follows from published figures."""
    source: str
    """The publication, and the derivation of the interval."""
    measure: Callable[[Run], float]
    """Returns the figure of a run."""

    @property
    def interval(self) -> str:
        """The interval in words."""
        if math.isinf(self.high):
            return f"at least {self.low:g} {self.unit}"
        return f"{self.low:g} to {self.high:g} {self.unit}"


def negotiation_s(run: Run) -> float:
    """Return the additional time that two people need for a pose that has to be inferred [s].

    The mean time to the right pose where the far end stays or moves the other way, less that where
    the table stays level.
    """
    times = {
        found: [
            each.scores["settling_ms"] / 1000
            for each in run.episodes
            if (each.behaviour == "together") != found and each.failure is None
        ]
        for found in (True, False)
    }
    return float(np.mean(times[True]) - np.mean(times[False]))


def roles_mw(run: Run) -> float:
    """Return the increase in leading to one's own hurdle with less information about the partner.

    The pair plays the lifts with two hurdles, with the seeds below :data:`CROSSING_SEEDS`, twice:
    as they are, and with an uncertainty of :data:`LITTLE_KNOWN`. The figure is the mean difference
    of the power with which the holders of hurdles lead [mW], at the lower end of its 95 % interval,
    over the hurdles that are crossed both times. A suite alone has few of these.
    """
    suite = run.suite.with_seeds(0, CROSSING_SEEDS)
    both = [each for each in suite.scenarios if each.behaviour in ("abreast", "ahead", "behind")]
    task = Agree(uncertainty=LITTLE_KNOWN)
    uncertain = [dataclasses.replace(each, task=task) for each in both]
    more, less = (
        _leading_mw(human_human_run(dataclasses.replace(suite, scenarios=tuple(each))))
        for each in (uncertain, both)
    )
    crossed = np.isfinite(more) & np.isfinite(less)
    ends = np.broadcast_to(np.arange(2), crossed.shape)[crossed].tolist()
    return paired_difference(more[crossed], less[crossed], Units.episodes(ends)).ends[0]


def _leading_mw(run: Run) -> NDArray[np.float64]:
    """Return the power with which the holder of each end leads [mW], (lifts, 2)."""
    return np.array(
        [[each.scores["human_leads_mw"], each.scores["robot_leads_mw"]] for each in run.episodes]
    )


LITTLE_KNOWN: Final = 0.2
"""Uncertainty of the far end's speed with little information about the partner [m/s]."""

CROSSING_SEEDS: Final = 20
"""Lifts of each behaviour and person that :func:`roles_mw` plays."""

PUBLISHED: Final[Mapping[str, Published]] = {
    Intent.name: Published(
        what="what a negotiation costs",
        unit="s",
        low=0.19,
        high=1.65,
        source="Rysbek et al. 2023 (arXiv 2308.09177), from their annotations: pairs who "
        "negotiate choose a goal after 2.49 to 3.95 s (quartiles), others after 2.30 s (median)",
        measure=negotiation_s,
    ),
    Agree.name: Published(
        what="who knows less of the partner leads more to the own hurdle, beyond a 95 % interval",
        unit="mW",
        low=0.0,
        high=math.inf,
        source="Chackochan and Sanguineti 2019, abstract: with unreliable information about the "
        "partner the roles of leader and follower alternate, with reliable information there are "
        "none; a direction, so that the bar is chance",
        measure=roles_mw,
    ),
}
"""The published figure for each task that has one."""
