"""Limits of tilt and shaking: what a policy may not do, although each command is allowed.

Both are far from what lifting takes. In 24 lifts of the four behaviours, the project's own
policies let the ends be at most 81 mm apart, and took back at most 172 mm of way in a second;
``hold`` and ``random``, which do not follow the person, let them be up to 296 mm apart.
"""

from collections import deque
from collections.abc import Sequence
from itertools import pairwise
from typing import Final

from .ports import Sample
from .stops import Stop, StopTrialError

LARGEST_TILT: Final = 0.14
"""Largest difference in height of the table's ends [m]: 10 degrees for a table of 0.8 m. With a
friction of 0.2, that of smooth wood, things on it begin to slide at 11.3 degrees."""

TILT_TIME: Final = 0.5
"""How long the person may tilt the table further, and the policy want to [s]: as long as the hands
take to see it and to make up for it at their highest speed, 0.35 s."""

WAY_BACK: Final = 0.25
"""Way [m] that the commands of a second may take back. At the highest speed, a turn in each period
of 0.1 s takes back 0.36 m, and going up and down once takes back 0.2 m."""

WINDOW: Final = 1.0
"""The second in question [s]."""


def way_back(commands: Sequence[float]) -> float:
    r"""Return how much of the way of some commands was taken back [m]: path less range.

    .. math:: b = \sum_k |c_k - c_{k-1}| - (\max_k c_k - \min_k c_k)
    """
    path = sum(abs(after - before) for before, after in pairwise(commands))
    return path - (max(commands) - min(commands))


class Conduct:
    """Watches the table and the commands of a trial.

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
        """Return the height to command [m]: one that tilts the table no further than it may be.

        It never makes the hands move that would stay: a table that the person tilts is not made
        up for here.

            clip(wanted, min(command, human_end - limit), max(command, human_end + limit))

        Parameters
        ----------
        wanted
            What the policy wants, within the limits of the hands [m].
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
        """Take in the newest plausible heights of the ends, after a command.

        Raises
        ------
        StopTrialError
            If the table has been tilted too far for too long, or was only kept from it.
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
                f"the table is tilted: for {TILT_TIME:g} s its ends were more than "
                f"{1000 * self._tilt:.0f} mm apart, or were to be; now {1000 * apart:.0f} mm",
            )

    def commands(self, now: float, command: float) -> None:
        """Take in the command of a step [m].

        Raises
        ------
        StopTrialError
            If the commands shake the table.
        """
        self._commands.append((now, command))
        while self._commands[0][0] < now - WINDOW - 1e-6:
            self._commands.popleft()
        back = way_back([command for _, command in self._commands])
        if back > WAY_BACK:
            raise StopTrialError(
                Stop.POLICY,
                f"the policy shakes the table: it took {1000 * back:.0f} mm of its way back within "
                f"{WINDOW:g} s, more than {1000 * WAY_BACK:.0f} mm",
            )
