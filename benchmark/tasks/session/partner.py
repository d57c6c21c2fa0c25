"""The second of two people, who gets to know the first in a session."""

import dataclasses
from typing import Final

from colift.agents.agent import FRAME, Action, HumanObservation, Observation
from colift.agents.humans import SECOND_PERSON, SecondPerson
from colift.agents.humans.second_person import SecondPersonParameters
from colift.agents.rules import SCALARS
from colift.benchmark.tasks.session.acquaintance import (
    STRANGER,
    Acquaintance,
    after_lift,
    impression,
)

CAUTION: Final = 0.08
"""Time by which a person who does not trust the other one is behind [s] (assumed): two people then
improve by about a fifth over ten lifts."""

_LATE: Final = round(SECOND_PERSON.visual_delay / FRAME)


class KnowingPartner:
    """Keeps the table level as :class:`.SecondPerson` does, and makes up for the own lag.

    After each lift the person knows how far the own end was behind the other one
    (:func:`.impression`), learns it as the first person does (:func:`.after_lift`), and intends to
    be as much earlier in the next lift. A person who does not trust the other one yet is more
    cautious, and later.
    """

    def __init__(self) -> None:
        self.begin_session()

    def begin_session(self) -> None:
        """Begin with a new person."""
        self._known: Acquaintance[float] = STRANGER
        self._other: list[float] = []
        self._own: list[float] = []

    def reset(self, seed: int) -> None:
        """Begin a lift; the noise comes from ``seed``."""
        other, own = self._other[_LATE:], self._own[: len(self._own) - _LATE]
        if len(own) > 1:
            self._known = after_lift(SCALARS, self._known, impression(SCALARS, other, own))
        self._other, self._own = [], []
        usual = SecondPersonParameters()
        lag = usual.lag + CAUTION * (1.0 - self._known.trust) - self._known.lag
        self._person = SecondPerson(parameters=dataclasses.replace(usual, lag=lag))
        self._person.reset(seed)

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        action = self._person.act(observation)
        new = slice(-min(len(action), HumanObservation.OWN_HEIGHT.stop), None)
        self._other += observation[HumanObservation.OTHER_END][new].tolist()
        self._own += observation[HumanObservation.OWN_HEIGHT][new].tolist()
        return action
