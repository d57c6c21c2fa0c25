"""Progress of an evaluation: stages, callbacks, time budget and the hidden run's duration."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Literal

from colift.base.errors import InputError
from colift.benchmark.episode.loop import Episode

Stage = Literal["two people", "check", "public run", "audit", "verification", "hidden run"]
"""Stage of an evaluation."""


HIDDEN: Final[Stage] = "hidden run"
"""The last stage: hidden lifts and their audit. Its progress is not reported."""


@dataclass(frozen=True, kw_only=True)
class Callbacks:
    """Progress callbacks of an evaluation; each call also serves as a heartbeat."""

    stage: Callable[[Stage], None] = lambda stage: None
    """Called when a stage begins."""
    progress: Callable[[int], None] = lambda episodes: None
    """Called with the number of episodes finished since the last call; see
    :func:`.episode_count`."""
    total: Callable[[int], None] = lambda episodes: None
    """Called with the total number of episodes, as soon as it is known."""
    output: Callable[[str], None] = lambda text: None
    """Called with the end of the policy's output in a lift of the check or the public run because
    of which it fails; never with that of a hidden lift."""


SECONDS: Final = 7200.0
"""Time budget of a policy in an evaluation [s]: over ten seconds for each of the 650 lifts of the
standard suite, which last seven to ten seconds."""


class BudgetError(InputError):
    """A policy has taken more time than an evaluation may take."""


class Budget:
    """The sum of the times that a policy takes in its lifts: for its start, and for its steps.

    Parameters
    ----------
    seconds
        The budget [s].
    """

    def __init__(self, seconds: float = SECONDS) -> None:
        self._seconds = self._left = seconds

    def add(self, place: int, episode: Episode) -> None:
        """Add the time of a lift; its place in the suite does not matter.

        Raises
        ------
        BudgetError
            If the sum exceeds the budget.
        """
        self._left -= episode.policy_time
        if self._left < 0:
            raise BudgetError(
                f"the policy took more than {self._seconds:g} s for all lifts of an evaluation "
                "together: it must start and act faster"
            )


TICK_S: Final = 0.2
"""Step to which the duration of a hidden run is rounded up, per lift of it [s]: one minute on the
standard suite."""


class HiddenRunTimer:
    """A wait at the end of a hidden run until its duration is a whole number of ticks.

    A policy chooses how long its steps take, so it could reveal by the duration of a hidden run
    what it has seen there.

    Parameters
    ----------
    lifts
        Number of hidden lifts; 0 waits for nothing.
    """

    def __init__(self, lifts: int) -> None:
        self._tick = lifts * TICK_S
        self._began: float | None = None

    def stage(self, stage: Stage) -> None:
        """Record that a stage begins."""
        if stage == HIDDEN:
            self._began = time.monotonic()

    def wait(self) -> None:
        """Wait, if there was a hidden run."""
        if self._tick and self._began is not None:
            time.sleep(self._tick - (time.monotonic() - self._began) % self._tick)
