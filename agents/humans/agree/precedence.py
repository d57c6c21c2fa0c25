"""Precedence at two hurdles: the time to go to one's own."""

from typing import Final

NEEDED: Final = 0.7
"""Time that a passage needs [s]."""

EARLY: Final = 0.25
"""Time before the window opens at which a passage may begin [s]."""

NEAR: Final = 0.006
FAR_NEAR: Final = 0.015
"""Distances of the person's end and of the far end from the hurdle within which the table counts as
having passed [m]."""

AWAY: Final = 0.02
"""Distance from the common height beyond which a partner has a goal of its own [m]."""

LEVEL: Final = 0.008
"""Height difference of the ends within which the table is level [m]."""

SLOW: Final = 0.05
"""Speed below which the table rests there [m/s]."""

SERVED: Final = 0.2
"""Time that the table rests at the partner's goal until the person takes that hurdle as passed
[s]."""


class Precedence:
    """Decides when to go to one's own hurdle, when to give way, and when it is passed.

    The turn comes at the share ``patience`` of the time between the earliest and the latest moment
    to begin, or as soon as the partner has been at its own goal. A partner who is seen to go to a
    goal of its own may go first, up to the latest moment. If both have begun, the person insists
    for a while and then gives way, until the partner has been at its goal.

    Parameters
    ----------
    patience, insistence
        Numbers of the person's :class:`.AgreeingManner`.
    """

    def __init__(self, patience: float, insistence: float) -> None:
        self._patience, self._insistence = patience, insistence
        self._begun = self._served = self._gave_way = False
        self._conflict = self._rested = 0.0
        self.passed = False

    def mine(self, start: float, stop: float, *, apart: bool, period: float) -> bool:
        """Return whether to go to the hurdle now.

        Parameters
        ----------
        start, stop
            When the window opens and closes, from now [s].
        apart
            Whether the partner goes to a goal of its own.
        period
            Time since the last call [s].
        """
        earliest, latest = start - EARLY, stop - NEEDED
        patience = 0.0 if self._served else self._patience
        at = earliest + patience * (latest - earliest)
        if self.passed or stop <= 0.0 or at > 0.0:
            return False
        if not self._begun:
            self._begun = not apart or self._served or latest <= 0.0
            return self._begun
        self._conflict = self._conflict + period if apart else 0.0
        self._gave_way = self._gave_way or self._conflict > self._insistence
        return self._served or not self._gave_way

    def see(self, height: float, start: float, own: float, far: float) -> None:
        """Note whether the table passes the person's own hurdle, by the seen heights [m]."""
        if start <= 0.0 and abs(own - height) < NEAR and abs(far - height) < FAR_NEAR:
            self.passed = True

    def serve(self, away: float, apart: float, speed: float, period: float) -> None:
        """Note whether the table rests, level, at a goal of the partner's.

        Parameters
        ----------
        away, apart
            Seen distances of the far end from the common height and from the person's own end [m].
        speed
            Seen speed of the far end [m/s].
        period
            Time since the last call [s].
        """
        resting = away > AWAY and apart < LEVEL and speed < SLOW
        self._rested = self._rested + period if resting else 0.0
        self._served = self._served or self._rested >= SERVED
