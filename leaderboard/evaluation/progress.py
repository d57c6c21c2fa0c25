"""Progress of an evaluation: stages, callbacks, time budget and the hidden run's duration."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Literal

from ...agents.errors import InputError
from ...benchmark.episode.episode import Episode

Stage = Literal[
    "human-human baseline", "check", "public run", "audit", "verification", "hidden run"
]
"""Stage of an evaluation."""


HIDDEN: Final[Stage] = "hidden run"
"""The last stage: hidden lifts and their audit. Its progress is not reported."""


@dataclass(frozen=True, kw_only=True)
class Callbacks:
    """Progress callbacks of an evaluation; each call also serves as a heartbeat."""

    stage: Callable[[Stage], None] = lambda stage: None
    """Called at the beginning of a stage."""
    progress: Callable[[int], None] = lambda episodes: None
    """Called with the number of episodes finished since the last call; see
    :func:`.episode_count`."""
    total: Callable[[int], None] = lambda episodes: None
    """Called with the number of episodes in all, as soon as it is known."""


SECONDS: Final = 7200.0
"""Time of a policy in an evaluation [s]: over ten seconds for each of the 650 lifts of the standard
suite, each of which lasts seven to ten."""


class BudgetError(InputError):
    """A policy has taken more time than an evaluation may take."""


class Budget:
    """Adds up what a policy's lifts take: starting it, and its steps.

    Parameters
    ----------
    seconds
        What they may take [s].
    """

    def __init__(self, seconds: float = SECONDS) -> None:
        self._seconds = self._left = seconds

    def add(self, place: int, episode: Episode) -> None:
        """Count a lift, wherever in its suite it is.

        Raises
        ------
        BudgetError
            If that is too much.
        """
        self._left -= episode.policy_time
        if self._left < 0:
            raise BudgetError(
                f"the policy took more than {self._seconds:g} s for all lifts of an evaluation "
                "together: it must start sooner or think less"
            )


TICK_S: Final = 0.2
"""Time by which the end of a hidden run is rounded up, for each of its lifts [s]: one minute on the
standard suite."""


class HiddenRunTimer:
    """Waits at the end of a hidden run until its duration is a whole number of ticks.

    A policy chooses how long it thinks, so the duration of a hidden run is a way to tell what it
    has seen there.

    Parameters
    ----------
    lifts
        Number of hidden lifts; 0 waits for nothing.
    """

    def __init__(self, lifts: int) -> None:
        self._tick = lifts * TICK_S
        self._began: float | None = None

    def stage(self, stage: Stage) -> None:
        """Take notice of a stage that begins."""
        if stage == HIDDEN:
            self._began = time.monotonic()

    def wait(self) -> None:
        """Wait, if there was a hidden run."""
        if self._tick and self._began is not None:
            time.sleep(self._tick - (time.monotonic() - self._began) % self._tick)
