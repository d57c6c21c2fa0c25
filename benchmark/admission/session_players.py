"""Who plays in the admission of a suite of sessions: networks that differ in what they know."""

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from itertools import chain
from typing import Final

from colift.agents.agent import Agent
from colift.agents.control.recurrent import GatedNetwork
from colift.agents.sessions.session_controller import SessionController
from colift.agents.spec import InProcess
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.playing import play_session
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import Due, Suite
from colift.benchmark.tasks.session.told_controller import ToldSession

REMEMBER: Final = "remember"
FORGET: Final = "forget"
TOLD: Final = "told"
OTHER: Final = "another's memory"

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


def scores_of(
    suite: Suite,
    player: str,
    network: GatedNetwork,
    executor: Executor | None,
    progress: Callable[[int], None],
) -> ScoreTable:
    """Return the scores of a player, one of :data:`PLAYERS`, with a network."""
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
