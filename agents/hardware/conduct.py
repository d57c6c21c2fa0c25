"""Limits of tilt and shaking: misconduct of a policy whose single commands are all allowed.

Both limits are far from normal lifting. In 24 lifts of the four behaviours, the built-in policies
kept the ends within 81 mm and reversed at most 172 mm of path within a second; ``hold`` and
``random``, which do not follow the person, let the ends be up to 296 mm apart.
"""

from collections import deque
from collections.abc import Sequence
from itertools import pairwise
from typing import Final

from colift.agents.hardware.ports import Sample
from colift.agents.hardware.stops import Stop, StopTrialError

LARGEST_TILT: Final = 0.14
"""Largest difference in height of the table's ends [m]: 10 degrees for a table of 0.8 m. With a
friction of 0.2, that of smooth wood, objects on it begin to slide at 11.3 degrees."""

TILT_TIME: Final = 0.5
"""Longest time of a larger tilt, real or commanded [s]: more than the 0.35 s in which the hands can
observe and level it at their highest speed."""

LARGEST_REVERSAL: Final = 0.25
"""Longest path [m] that the commands of one second may reverse. At the highest speed, a turn in
each period of 0.1 s reverses 0.36 m, and going up and down once reverses 0.2 m."""

WINDOW: Final = 1.0
"""Time over which reversals add up [s]."""


def reversed_path(commands: Sequence[float]) -> float:
    r"""Return the reversed part of the path of some commands [m]: path less range.

    .. math:: b = \sum_k |c_k - c_{k-1}| - (\max_k c_k - \min_k c_k)
    """
    path = sum(abs(after - before) for before, after in pairwise(commands))
    return path - (max(commands) - min(commands))


class Conduct:
    """Supervision of the table and the commands of a trial.

    Parameters
    ----------
    tilt
        Largest difference in height of the table's ends [m].
    """

    def __init__(self, tilt: float) -> None:
        self._tilt = tilt
        self._clipped = False
        self._tilted_since: float | None = None
        self._commands: deque[tuple[float, float]] = deque()

    def level(self, wanted: float, command: float, human_end: float) -> float:
        """Return the height to command [m], clipped to a tilt within the limit.

        It never moves hands that would otherwise stay: a tilt caused by the person is not corrected
        here.

            clip(wanted, min(command, human_end - limit), max(command, human_end + limit))

        Parameters
        ----------
        wanted
            The policy's target, within the limits of the hands [m].
        command
            The last command [m].
        human_end
            Height of the human's end [m].
        """
        low = min(command, human_end - self._tilt)
        high = max(command, human_end + self._tilt)
        height = min(max(wanted, low), high)
        self._clipped = height != wanted
        return height

    def tilts(self, now: float, ends: Sample) -> None:
        """Check the newest plausible heights of the ends, after a command.

        Raises
        ------
        StopTrialError
            If the table has been tilted too far for too long, or only clipping prevented it.
        """
        apart = abs(ends.human_end - ends.robot_end)
        if apart <= self._tilt and not self._clipped:
            self._tilted_since = None
            return
        if self._tilted_since is None:
            self._tilted_since = now
        if now - self._tilted_since > TILT_TIME - 1e-6:
            raise StopTrialError(
                Stop.POLICY,
                f"the table is tilted: for {TILT_TIME:g} s its ends were, or were commanded to be, "
                f"more than {1000 * self._tilt:.0f} mm apart; now {1000 * apart:.0f} mm",
            )

    def commands(self, now: float, command: float) -> None:
        """Check the command of a step [m].

        Raises
        ------
        StopTrialError
            If the commands shake the table.
        """
        self._commands.append((now, command))
        while self._commands[0][0] < now - WINDOW - 1e-6:
            self._commands.popleft()
        reversal = reversed_path([command for _, command in self._commands])
        if reversal > LARGEST_REVERSAL:
            raise StopTrialError(
                Stop.POLICY,
                f"the policy shakes the table: it reversed {1000 * reversal:.0f} mm of its path "
                f"within {WINDOW:g} s, more than {1000 * LARGEST_REVERSAL:.0f} mm",
            )
