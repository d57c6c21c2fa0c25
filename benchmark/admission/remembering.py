"""The admission of a suite of sessions: whether it pays to remember the person.

Networks of one kind and one budget show it: one that keeps what it has learned from lift to lift,
one that does not, and one that does not and is told the person's habits.
"""

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from itertools import chain
from typing import Final

import numpy as np
from colift.agents.agent import Agent
from colift.agents.control.recurrent import GatedNetwork
from colift.agents.sessions.session_controller import SessionController
from colift.agents.spec import InProcess
from colift.base.errors import InputError
from colift.benchmark.admission.assessment import Admission
from colift.benchmark.admission.criteria import Criterion
from colift.benchmark.admission.played import Played
from colift.benchmark.admission.ratio import ratio_criterion
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.playing import play_session
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL, human_human_run
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import Due, Suite
from colift.benchmark.tasks.session.habitual import Habitual
from colift.benchmark.tasks.session.told_controller import ToldSession
from colift.benchmark.training.session_kinds import Kind

MEMORY: Final = "it pays to remember the person"
"""What a suite of sessions can claim."""

PAYS: Final = 0.85
"""Largest error of a robot that remembers, over that of one that does not."""

OWN: Final = 0.8
"""Largest error with the memory of the person, over that with the memory of another one."""

NOTHING: Final = 0.95
"""Least of the first ratio where people have no habits."""

REMEMBER: Final = "remember"
FORGET: Final = "forget"
TOLD: Final = "told"
OTHER: Final = "another's memory"
FIRST, LAST = "two people, first lift", "two people, last lifts"

PLAYERS: Final = (REMEMBER, FORGET, TOLD, OTHER)


@dataclass(frozen=True, kw_only=True)
class Given(InProcess):
    """An agent that is there already, as :class:`.AgentSpec`."""

    made: Agent
    name: str = ""

    def check(self) -> None:
        """Do nothing."""

    def digest(self) -> str:
        """Return nothing: it has no place in a table."""
        return ""

    def make(self) -> Agent:
        """Return the agent."""
        return self.made


class Implanted(SessionController):
    """A network whose units are exchanged before one lift of a session."""

    def __init__(self, network: GatedNetwork, units: object, place: int) -> None:
        super().__init__(network)
        self._units, self._left = units, place

    def reset(self, seed: int) -> None:
        """Begin a lift; the one at the place begins with the other units."""
        super().reset(seed)
        if self._left == 0:
            self._memory = self._memory._replace(units=self._units)
        self._left -= 1


@dataclass(frozen=True, kw_only=True)
class SessionTask:
    """The session of one person with a player, for a worker process."""

    player: str
    """One of :data:`PLAYERS`."""
    network: GatedNetwork
    lifts: tuple[Due, ...]
    before: tuple[Due, ...]
    """The first lifts of another person, whose memory :data:`OTHER` has in the lifts that count."""

    def __call__(self) -> list[Episode]:
        """Return the episodes."""
        return list(play_session(Given(made=self._agent()), self.lifts))

    def _agent(self) -> Agent:
        if self.player == TOLD:
            return ToldSession(self.network, self.lifts[0].scenario.subject)
        if self.player != OTHER:
            return SessionController(self.network, remember=self.player == REMEMBER)
        elsewhere = SessionController(self.network)
        for _ in play_session(Given(made=elsewhere), self.before):
            pass
        return Implanted(self.network, elsewhere.units, len(self.before))


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
    return (len(PLAYERS) + 3) * suite.size


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
        name: _table(suite, name, every[name], executor, progress) for name in PLAYERS
    }
    played = Played.of(tables)
    control = without_habits(suite)
    usual = Played.of(
        {
            name: _table(control, name, every[name], executor, progress)
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
        ),
        control=None,
    )


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


def _table(
    suite: Suite,
    player: str,
    network: GatedNetwork,
    executor: Executor | None,
    progress: Callable[[int], None],
) -> ScoreTable:
    """Return the scores of a player."""
    tasks = list(_tasks(suite, player, network))
    play = SessionTask.__call__
    found = map(play, tasks) if executor is None else executor.map(play, tasks)
    sessions: list[list[Episode]] = []
    for session in found:
        sessions.append(session)
        progress(len(session))
    episodes = tuple(chain.from_iterable(sessions))
    return ScoreTable.of(Run(policy=player, policy_digest="", suite=suite, episodes=episodes))


def _tasks(suite: Suite, player: str, network: GatedNetwork) -> Iterator[SessionTask]:
    lifts = [suite.at(place) for place in range(suite.size)]
    sessions = [
        tuple(lifts[first : first + suite.session]) for first in range(0, suite.size, suite.session)
    ]
    known = sum(not suite.counts(place) for place in range(suite.session))
    for number, session in enumerate(sessions):
        other = sessions[(number + 1) % len(sessions)]
        yield SessionTask(player=player, network=network, lifts=session, before=other[:known])


def _improvement(suite: Suite, people: ScoreTable) -> Played:
    """Return the errors of two people in the first lift, and in those that count."""
    errors = np.reshape(people.lifts_mm, (-1, suite.session))
    counted = sum(map(suite.counts, range(suite.session)))
    last = errors[:, -counted:]
    first = np.repeat(errors[:, :1], counted, axis=1)
    names: Sequence[str] = [each.subject.name for each in suite.scenarios]
    return Played(players=(FIRST, LAST), people=tuple(names), errors=np.array((first, last)))
