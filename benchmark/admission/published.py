"""Published figures of two people, as references for the simulated pair of a task."""

import math
from collections.abc import Callable, Mapping, Set
from dataclasses import dataclass, replace
from typing import Final, Self

import numpy as np
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.baselines import human_human_run
from colift.benchmark.tasks.agree.task import Agree
from colift.benchmark.tasks.ball.task import BallSteering
from colift.benchmark.tasks.intent.task import Intent
from numpy.typing import NDArray

Figure = Callable[[Set[str]], float]
"""Returns a figure of a pair from its lifts without some people."""


@dataclass(frozen=True, kw_only=True)
class Published:
    """A published figure of two people, and its counterpart of two simulated people."""

    what: str
    """The figure in words."""
    unit: str
    low: float
    high: float
    """The interval that was published, or follows from published figures."""
    source: str
    """The publication, what was used of it, and the derivation of the interval."""
    measure: Callable[[Run], Figure]
    """Returns the figure of a run."""

    @property
    def interval(self) -> str:
        """The interval in words."""
        if math.isinf(self.high):
            return f"at least {self.low:g} {self.unit}"
        return f"{self.low:g} to {self.high:g} {self.unit}"


@dataclass(frozen=True, kw_only=True)
class Compared:
    """A published figure, and that of two simulated people."""

    published: Published
    measured: Figure
    people: tuple[str, ...]
    left_out: frozenset[str] = frozenset()

    @property
    def figure(self) -> float:
        """The figure of the simulated people."""
        return self.measured(self.left_out)

    @property
    def without_each(self) -> tuple[float, ...]:
        """The figure without each of the people."""
        return tuple(self.measured(self.left_out | {each}) for each in self.people)

    def without(self, person: str) -> Self:
        """Return the comparison without a person."""
        kept = tuple(each for each in self.people if each != person)
        return replace(self, people=kept, left_out=self.left_out | {person})


def compared(human_human: Run) -> Compared | None:
    """Return the published figure of the task and that of a human-human run, or None."""
    published = PUBLISHED.get(human_human.suite.scenarios[0].task.name)
    if published is None:
        return None
    people = dict.fromkeys(each.subject for each in human_human.episodes)
    return Compared(
        published=published, measured=published.measure(human_human), people=tuple(people)
    )


def negotiation_s(run: Run) -> Figure:
    """Return the additional time that two people need for a pose that has to be inferred [s].

    The mean time to the right pose where the far end stays or moves the other way, less that where
    the table stays level.
    """
    times = [
        (each.subject, each.behaviour != "together", each.scores["settling_ms"] / 1000)
        for each in run.episodes
        if each.failure is None and math.isfinite(each.scores["settling_ms"])
    ]

    def figure(left_out: Set[str]) -> float:
        negotiated, other = (
            np.mean([time for who, found, time in times if who not in left_out and found == kind])
            for kind in (True, False)
        )
        return float(negotiated - other)

    return figure


def roles_mw(run: Run) -> Figure:
    """Return the increase in leading to one's own hurdle with less information about the partner.

    The pair plays the lifts with two hurdles, with the seeds below :data:`CROSSING_SEEDS`, twice:
    as they are, and with an uncertainty of :data:`LITTLE_KNOWN`. The figure is the mean difference
    of the power with which the holders of hurdles lead [mW], over the hurdles that are crossed both
    times. A suite alone has few of these.
    """
    suite = run.suite.with_seeds(0, CROSSING_SEEDS)
    both = [each for each in suite.scenarios if each.behaviour in ("abreast", "ahead", "behind")]
    task = Agree(uncertainty=LITTLE_KNOWN)
    uncertain = [replace(each, task=task) for each in both]
    more, less = (
        human_human_run(replace(suite, scenarios=tuple(each))) for each in (uncertain, both)
    )
    gained = _leading_mw(more) - _leading_mw(less)
    people = [each.subject for each in less.episodes]

    def figure(left_out: Set[str]) -> float:
        return float(np.nanmean(gained[[each not in left_out for each in people]]))

    return figure


def _leading_mw(run: Run) -> NDArray[np.float64]:
    """Return the power with which the holder of each end leads [mW], (lifts, 2)."""
    return np.array(
        [[each.scores["human_leads_mw"], each.scores["robot_leads_mw"]] for each in run.episodes]
    )


LITTLE_KNOWN: Final = 0.2
"""Uncertainty of the far end's speed with little information about the partner [m/s]."""

CROSSING_SEEDS: Final = 4
"""Lifts of each behaviour and person that :func:`roles_mw` plays."""

PUBLISHED: Final[Mapping[str, Published]] = {
    Intent.name: Published(
        what="what a negotiation costs",
        unit="s",
        low=0.19,
        high=1.65,
        source="Rysbek et al. 2023 (arXiv 2308.09177), their annotations of real pairs: those who "
        "negotiate choose a goal after 2.49 to 3.95 s (quartiles), others after 2.30 s (median)",
        measure=negotiation_s,
    ),
    Agree.name: Published(
        what="who knows less of the partner leads more to the own hurdle",
        unit="mW",
        low=0.0,
        high=math.inf,
        source="Chackochan and Sanguineti 2019 (PLoS Comput. Biol. 15(12), e1006385): the abstract "
        "alone, with no figure: with unreliable information about the partner the roles of leader "
        "and follower alternate, with reliable information there are none; a direction, so that "
        "the bar is chance",
        measure=roles_mw,
    ),
}
"""The published figure for each task that has one."""

NOT_COMPARED: Final[Mapping[str, str]] = {
    BallSteering.name: "Liu et al. 2022 (arXiv 2203.01287) and 2025 (Scientific Reports 15, "
    "10.1038/s41598-025-27258-5): the abstracts alone were used, which state directions and no "
    "figure, for a ball on a board; nothing to compare",
}
"""Why a task has no published figure, where publications of such pairs exist."""
