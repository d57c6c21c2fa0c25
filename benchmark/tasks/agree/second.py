"""The second human: keeps level with the other, and has a hurdle of its own."""

import math
from typing import Final

import numpy as np
from colift.agents.agent import FRAME, HISTORY, Action, HumanObservation, Observation
from colift.agents.humans import SECOND_PERSON, ScriptedHuman, Subject
from colift.agents.humans.second_person import SecondPersonParameters
from colift.agents.rules import SCALARS
from colift.benchmark.tasks.agree.manner import AgreeingManner, agreeing_manner
from colift.benchmark.tasks.agree.negotiating import (
    LIFTED,
    AgreeingSenses,
    Detour,
    approach,
    beginning,
    negotiate,
    response,
)
from colift.benchmark.tasks.agree.precedence import Secret

PRIVATE: Final = len(Secret._fields) + 1
"""Numbers of a person's observation before :class:`.HumanObservation`."""

LOWERED: Final = 0.06
"""Height below which the other end is being lowered to the ground [m]."""

STEADY: Final = 0.05
"""Speed below which the other end rests [m/s]."""

STILL: Final = 0.3
"""Time that the other end rests until its height is taken as the common one [s]."""


def with_secret(view: Observation, secret: Secret[float], uncertainty: float) -> Observation:
    """Return the observation of a person with a hurdle.

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


class SecondNegotiator:
    """The person at the far end of a human-human pair; the observation is :func:`with_secret`.

    It does not know the common way, but follows the end that it sees, as :class:`.SecondPerson`
    does; the height at which that end first comes to rest is the common height. In its turn
    (:func:`.negotiate`) the hand moves from there to its own hurdle. The hand has a person's noise,
    tremor and correction (:class:`.ScriptedHuman`).

    Parameters
    ----------
    subject
        The person.
    manner
        The person's manner; by default that of :func:`.agreeing_manner`.
    """

    def __init__(
        self, *, subject: Subject = SECOND_PERSON, manner: AgreeingManner[float] | None = None
    ) -> None:
        self._hand = ScriptedHuman(subject=subject)
        self._manner = manner or agreeing_manner(subject)
        self._delay = round(subject.visual_delay / FRAME)
        self._parameters = SecondPersonParameters()
        self._ahead = subject.visual_delay - self._parameters.lag

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._hand.reset(seed)
        self._rng = np.random.default_rng((seed, 1))
        self._memory = beginning(SCALARS, 0.0, False)
        self._detour = Detour(0.0, 0.0)
        self._own = [0.0] * (self._delay + HISTORY)
        self._height = self._velocity = self._still = 0.0
        self._rested = self._apart = False

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        *own, uncertainty = observation[:PRIVATE].tolist()
        hurdle, view = Secret(*own), observation[PRIVATE:].copy()
        way = self._way(view)
        senses = self._senses(view, len(way), uncertainty)
        self._memory, goes = negotiate(
            SCALARS,
            self._manner,
            self._memory,
            senses,
            hurdle,
            self._rested,
            way[-1],
            len(way) * FRAME,
        )
        wanted = way[-1]
        if self._rested and goes:
            wanted = response(SCALARS, self._manner, self._memory, hurdle, goes)
        base = self._base(way, goes)
        self._detour, heights = approach(SCALARS, self._detour, wanted - base[-1], base)
        view[HumanObservation.TARGET] = heights
        return self._hand.act(view)

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
        """Return the expected height of the other end in each of the next n frames [m]."""
        frames = len(view[HumanObservation.TARGET])
        new = view[HumanObservation.OTHER_END][-frames:].tolist()
        # A step longer than the history leaves a gap before the first new frame.
        elapsed = (frames - len(new) + 1) * FRAME
        for height in new:
            smoothing = -math.expm1(-elapsed / self._parameters.velocity_memory)
            self._velocity += smoothing * ((height - self._height) / elapsed - self._velocity)
            self._height = height
            elapsed = FRAME
        rests = abs(self._velocity) < STEADY and self._height > LIFTED
        self._still = self._still + frames * FRAME if rests else 0.0
        self._rested = self._height > LOWERED and (self._rested or self._still >= STILL)
        return [
            self._height + self._velocity * (self._ahead + FRAME * i) for i in range(1, frames + 1)
        ]

    def _base(self, way: list[float], goes: bool) -> list[float]:
        """Return the way or, in its turn, the common height; the hand does not jump."""
        common = self._memory.common
        fixed = way[0] if common == 0.0 else common
        if goes != self._apart:
            sign = 1.0 if goes else -1.0
            offset, rate = self._detour
            self._detour = Detour(offset + sign * (way[0] - fixed), rate + sign * self._velocity)
            self._apart = goes
        return [fixed] * len(way) if goes else way
