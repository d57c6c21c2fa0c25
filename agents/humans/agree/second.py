"""The second human: keeps level with the other, and has a hurdle of its own."""

import math
from typing import ClassVar, Final

from colift.agents.agent import FRAME, HumanObservation, Observation
from colift.agents.humans import PARTNER_SUBJECT, Subject
from colift.agents.humans.agree.manner import AgreeingManner
from colift.agents.humans.agree.negotiating import LIFTED, Detour
from colift.agents.humans.agree.negotiator import Negotiator
from colift.agents.humans.partner import PartnerParameters

LOWERED: Final = 0.06
"""Height below which the other end is being lowered to the ground [m]."""

STEADY: Final = 0.05
"""Speed below which the other end rests [m/s]."""

STILL: Final = 0.3
"""Time that the other end rests until its height is taken as the common one [s]."""


class SecondNegotiator(Negotiator):
    """The :class:`Negotiator` at the far end of a human-human pair.

    It does not know the common way, but follows the end that it sees as the :class:`.Partner` does;
    the height at which that end first comes to rest is the common height. In its turn the hand
    moves from there to its own hurdle.
    """

    _responds: ClassVar[bool] = False

    def __init__(
        self, *, subject: Subject = PARTNER_SUBJECT, manner: AgreeingManner[float] | None = None
    ) -> None:
        super().__init__(subject=subject, manner=manner)
        self._parameters = PartnerParameters()
        self._ahead = subject.visual_delay - self._parameters.lag

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        super().reset(seed)
        self._height = self._velocity = self._still = 0.0
        self._rested = self._apart = False

    def _way(self, view: Observation) -> list[float]:
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

    def _rests(self, way: list[float]) -> bool:
        return self._rested

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
