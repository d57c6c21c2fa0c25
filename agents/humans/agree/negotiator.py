"""The person who has a hurdle to pass, and a partner who may have another."""

from typing import Any, ClassVar, Final

import numpy as np
from colift.agents.agent import FRAME, HISTORY, Action, HumanObservation, Observation
from colift.agents.humans import ScriptedHuman, Subject
from colift.agents.humans.agree.manner import AgreeingManner, agreeing_manner
from colift.agents.humans.agree.negotiating import (
    AgreeingSenses,
    Detour,
    approach,
    beginning,
    negotiate,
    response,
    rests,
)
from colift.agents.humans.agree.precedence import Secret
from colift.agents.rules import SCALARS

PRIVATE: Final = len(Secret._fields) + 1
"""Numbers of a :class:`Negotiator`'s observation before :class:`.HumanObservation`."""


def with_secret(view: Observation, secret: Secret[float], uncertainty: float) -> Observation:
    """Return the observation of a :class:`Negotiator`.

    Parameters
    ----------
    view
        The senses, :class:`.HumanObservation`.
    secret
        The person's own hurdle.
    uncertainty
        Standard deviation of the perceived speed of the far end [m/s]: the less a person knows
        about the partner, the larger it is.
    """
    return np.concatenate((secret, (uncertainty,), view))


class Negotiator:
    """Carries out the common way, with detours to a hurdle of its own and to the partner's goal.

    The observation is that of :func:`with_secret`; its target is the common way. The person
    negotiates as :func:`.negotiate` and :func:`.response` say, and the hand's detour follows
    (:func:`.approach`). The hand has a person's noise, tremor and correction
    (:class:`.ScriptedHuman`); the answer to the felt force is the reflex of the body in the world.

    Parameters
    ----------
    subject
        The person.
    manner
        The person's manner; by default that of :func:`.agreeing_manner`.
    """

    def __init__(self, *, subject: Subject, manner: AgreeingManner[float] | None = None) -> None:
        self._hand = ScriptedHuman(subject=subject)
        self._manner = manner or agreeing_manner(subject)
        self._delay = round(subject.visual_delay / FRAME)

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._hand.reset(seed)
        self._rng = np.random.default_rng((seed, 1))
        self._memory = beginning(SCALARS, 0.0, False)
        self._detour = Detour(0.0, 0.0)
        self._own = [0.0] * (self._delay + HISTORY)

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        *own, uncertainty = observation[:PRIVATE].tolist()
        hurdle, view = Secret(*own), observation[PRIVATE:].copy()
        way = self._way(view)
        senses, resting = self._senses(view, len(way), uncertainty), self._rests(way)
        self._memory, goes = negotiate(
            SCALARS,
            self._manner,
            self._memory,
            senses,
            hurdle,
            resting,
            way[-1],
            len(way) * FRAME,
        )
        wanted = way[-1]
        if resting and (goes or self._responds):
            wanted = response(SCALARS, self._manner, self._memory, hurdle, goes)
        base = self._base(way, goes)
        self._detour, heights = approach(SCALARS, self._detour, wanted - base[-1], base)
        view[HumanObservation.TARGET] = heights
        return self._hand.act(view)

    _responds: ClassVar[bool] = True
    """Whether the person goes along with the partner's goal when it is not the own turn."""

    def _senses(self, view: Observation, frames: int, uncertainty: float) -> AgreeingSenses[float]:
        own = view[HumanObservation.OWN_HEIGHT].tolist()
        new = [own[0]] * (frames - len(own)) + own[-frames:]
        self._own = (self._own + new)[-(self._delay + HISTORY) :]
        return AgreeingSenses(
            own=own[-1],
            then=self._own[-1 - self._delay],
            far=float(view[HumanObservation.OTHER_END][-1]),
            sight=uncertainty * float(self._rng.standard_normal()),
            uncertainty=uncertainty,
        )

    def _way(self, view: Observation) -> list[float]:
        """Return the common way's height in each of the next n frames [m]."""
        way: list[float] = view[HumanObservation.TARGET].tolist()
        return way

    def _rests(self, way: list[float]) -> Any:
        """Return whether the common way rests above the ground."""
        return rests(SCALARS, way[0], way[-1], len(way))

    def _base(self, way: list[float], goes: Any) -> list[float]:
        """Return the heights to which the detour is added, in each of the next n frames [m]."""
        return way
