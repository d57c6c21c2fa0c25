"""People who have lifted with a robot for long, on the lifts of Table I.

A claim of the paper (section IV.E): subject 1 does best, having worked with the system for longer.
"""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Self

from colift.agents.humans import Smooth, Subject
from colift.agents.humans.person import Person
from colift.agents.rules import SCALARS
from colift.agents.spec import AgentSpec
from colift.benchmark.execution.runner import Run
from colift.benchmark.execution.sessions import after
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.session.acquaintance import (
    STRANGER,
    Acquaintance,
    after_lift,
    impression,
)
from colift.benchmark.tasks.session.person import Helps

PRACTICE: Final = 30
"""Lifts of practice (assumed; the paper says "a longer time")."""


@dataclass(frozen=True, kw_only=True)
class Knowing(Smooth):
    """Smooth lifts of a person who knows the partner; see :class:`.Helps`."""

    known: Acquaintance[float] = STRANGER
    """What the person has learned about the partner."""

    @property
    def rules(self) -> Person:
        """The rules of this person."""
        return Helps(known=self.known)


@dataclass(frozen=True, kw_only=True)
class Practising(Knowing):
    """The same of a person who goes on learning, as :class:`.Serial`."""

    place: int = 0
    counted: int = 1

    @property
    def trust(self) -> float:
        """Trust in the partner before this lift."""
        return self.known.trust

    def change(self, subject: Subject) -> None:
        """Change nothing."""

    def at(self, place: int) -> Self:
        """Return the behaviour in the lift at a place, of a person who has learned nothing."""
        return dataclasses.replace(self, place=place)

    def after(self, near: Sequence[float], far: Sequence[float]) -> Self:
        """Return the behaviour in the next lift."""
        known = after_lift(SCALARS, self.known, impression(SCALARS, near, far))
        return dataclasses.replace(self, place=self.place + 1, known=known)


@dataclass(frozen=True, kw_only=True, eq=False)
class PracticeRuns:
    """The same lifts of the same people with a policy, before and after practice with it."""

    stranger: Run
    practised: Run


def practice_runs(
    policy: AgentSpec, suite: Suite, run: Callable[[AgentSpec, Suite], Run]
) -> PracticeRuns:
    """Return the runs on the lifts of a suite.

    Parameters
    ----------
    policy
        The policy.
    suite
        Smooth lifts of some subjects.
    run
        Plays a policy on a suite.
    """
    before = suite.seeds[0] + len(suite.seeds)
    seeds = tuple(range(before, before + PRACTICE))
    practice = run(policy, dataclasses.replace(_with(suite, Practising()), seeds=seeds))
    lifts = iter(practice.episodes)
    known = []
    for scenario in practice.suite.scenarios:
        for _ in range(PRACTICE):
            scenario = after(scenario, next(lifts).trace)
        human: Any = scenario.human
        known.append(Knowing(known=human.known))
    return PracticeRuns(
        stranger=run(policy, _with(suite, Knowing())),
        practised=run(policy, _with(suite, *known)),
    )


def _with(suite: Suite, *people: Smooth) -> Suite:
    """Return the lifts of a suite with another person for each subject, or one for all."""
    humans = people if len(people) > 1 else people * len(suite.scenarios)
    scenarios = tuple(
        dataclasses.replace(each, human=human)
        for each, human in zip(suite.scenarios, humans, strict=True)
    )
    return dataclasses.replace(suite, scenarios=scenarios)
