"""The admission of a suite of sessions: whether it pays to remember the person.

Networks of one kind and one budget show it: one that keeps what it has learned from lift to lift,
one that does not, and one that does not and is told the person's habits.
"""

import dataclasses
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from typing import Final

import numpy as np
from colift.agents.control.recurrent import GatedNetwork
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.base.registry import remembering
from colift.benchmark.admission.assessment import Admission
from colift.benchmark.admission.criteria import Criterion, interaction
from colift.benchmark.admission.evidence import Evidence
from colift.benchmark.admission.fragility import judged
from colift.benchmark.admission.played import Played
from colift.benchmark.admission.ratio import ratio_criterion
from colift.benchmark.admission.session_players import (
    FORGET,
    OTHER,
    PLAYERS,
    REMEMBER,
    scores_of,
)
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL, human_human_run
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.session.habitual import Habitual
from colift.benchmark.training.session_kinds import Kind

MEMORY: Final = "it pays to remember the person"
"""What a suite of sessions can claim."""

PAYS: Final = 0.85
"""Largest error of a robot that remembers, over that of one that does not."""

OWN: Final = 0.8
"""Largest error with the memory of the person, over that with the memory of another one."""

NOTHING: Final = 0.95
"""Least of the first ratio where people have no habits."""

FIRST, LAST = "two people, first lift", "two people, last lifts"


def check_people(suite: Suite) -> None:
    """Raise an InputError if the people of a suite have no habits that could be told."""
    others = {each.behaviour for each in suite.scenarios if not isinstance(each.human, Habitual)}
    if others:
        raise InputError(
            f"{suite.name}: only sessions of people with habits (habitual) can be tested, got "
            f"{', '.join(sorted(others))}"
        )


def lifts_to_play(suite: Suite) -> int:
    """Return the number of lifts of :func:`memory_of`."""
    return (len(PLAYERS) + len(remembering()) + 3) * suite.size


def memory_of(
    suite: Suite,
    networks: Mapping[Kind, GatedNetwork],
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Admission:
    """Test a suite of sessions.

    Parameters
    ----------
    suite
        The suite, whose people are :class:`.Habitual`.
    networks
        The trained networks of :data:`REMEMBER`, :data:`FORGET` and :data:`TOLD`.
    executor, progress
        As for :func:`.run_suite`.

    Raises
    ------
    InputError
        If there are too few people.
    """
    people = ScoreTable.of(human_human_run(suite, executor=executor, progress=progress))
    every: dict[str, GatedNetwork] = dict(networks.items())
    every[OTHER] = networks[REMEMBER]
    tables = {HUMAN_HUMAN_LABEL: people} | {
        name: scores_of(suite, name, every[name], executor, progress) for name in PLAYERS
    }
    played = Played.of(tables)
    control = without_habits(suite)
    usual = Played.of(
        {
            name: scores_of(control, name, every[name], executor, progress)
            for name in (REMEMBER, FORGET)
        }
    )
    return Admission(
        suite=suite.name,
        digest=suite.digest,
        means=played.means,
        criteria=(
            ratio_criterion(
                played,
                REMEMBER,
                FORGET,
                _stated(
                    "a",
                    "error of a network that remembers the lifts before, over that of one that "
                    "does not",
                    f"at most {PAYS:g}",
                ),
                most=PAYS,
            ),
            ratio_criterion(
                played,
                REMEMBER,
                OTHER,
                _stated(
                    "b",
                    "what is remembered is the person: error over that with the memory of another "
                    "person",
                    f"at most {OWN:g}",
                ),
                most=OWN,
            ),
            ratio_criterion(
                _improvement(suite, people),
                LAST,
                FIRST,
                _stated("c", "two people get to know each other", "below 1"),
                most=1.0,
            ),
            ratio_criterion(
                usual,
                REMEMBER,
                FORGET,
                _stated(
                    "d",
                    "the same as a, where people have no habits: there is nothing to remember",
                    f"at least {NOTHING:g}",
                ),
                least=NOTHING,
                beyond=False,
            ),
            people_differ(suite, executor=executor, progress=progress),
        ),
        control=None,
    )


def people_differ(
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Criterion:
    """Return whether the best of colift's policies with memory depends on the person."""
    names = remembering()
    runs = (
        run_suite(PolicySpec(text=name), suite, executor=executor, progress=progress)
        for name in names
    )
    tables = {name: ScoreTable.of(run) for name, run in zip(names, runs, strict=True)}
    (found,) = judged(Evidence(played=Played.of(tables), policies=names), (interaction,))
    return dataclasses.replace(found, letter="e")


def _stated(letter: str, what: str, bar: str) -> Criterion:
    return Criterion(letter=letter, claim=MEMORY, what=what, bar=bar, detail="")


def without_habits(suite: Suite) -> Suite:
    """Return a suite of sessions with the same people, whose lifts have nothing in common."""
    scenarios = tuple(
        dataclasses.replace(each, human=dataclasses.replace(each.human, steady=False))
        for each in suite.scenarios
        if isinstance(each.human, Habitual)
    )
    return dataclasses.replace(suite, name=f"{suite.name} (no habits)", scenarios=scenarios)


def _improvement(suite: Suite, people: ScoreTable) -> Played:
    """Return the errors of two people in the first lift, and in those that count."""
    errors = np.reshape(people.lifts_mm, (-1, suite.session))
    counted = sum(map(suite.counts, range(suite.session)))
    last = errors[:, -counted:]
    first = np.repeat(errors[:, :1], counted, axis=1)
    names = tuple(each.subject.name for each in suite.scenarios)
    return Played(players=(FIRST, LAST), people=names, errors=np.array((first, last)))
