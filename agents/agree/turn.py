"""When it is one's own turn to go to one's own hurdle."""

from typing import Final

NEEDED: Final = 0.6
"""Time that a passage needs [s]."""

EARLY: Final = 0.25
"""How long before the window opens a passage may begin [s]."""

NEAR: Final = 0.006
FAR_NEAR: Final = 0.015
"""The table has passed when the own end is seen so near to the height, and the far end [m]."""


class Turn:
    """Decides when to go to the own hurdle, and when it is passed.

    The turn comes at the share ``patience`` of the time between the earliest and the latest moment
    to begin. A partner who is seen to go to a goal of its own is let go first, up to the latest.
    """

    def __init__(self, patience: float) -> None:
        self._patience = patience
        self.begun = self.passed = False

    def mine(self, start: float, stop: float, *, yielding: bool) -> bool:
        """Return whether to go to the hurdle now.

        Parameters
        ----------
        start, stop
            When the window opens and closes, from now [s].
        yielding
            Whether the partner goes to a goal of its own, and is let.
        """
        earliest, latest = start - EARLY, stop - NEEDED
        at = earliest + self._patience * (latest - earliest)
        if self.passed or stop <= 0.0 or at > 0.0:
            return False
        if not self.begun and yielding and latest > 0.0:
            return False
        self.begun = True
        return True

    def see(self, start: float, height: float, own: float, far: float) -> None:
        """Note whether the table passes the hurdle of a height, by the seen heights [m]."""
        if start <= 0.0 and abs(own - height) < NEAR and abs(far - height) < FAR_NEAR:
            self.passed = self.passed or self.begun
