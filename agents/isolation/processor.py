"""One processor for two processes that take turns.

If each has a processor to itself, every turn has to wake an idle one, and that takes longer than
the turn: a step costs twice as much. Every few turns the caller is free to be moved by the
scheduler, and the answerer follows: else two pairs might share a processor beside an idle one.
"""

import contextlib
import functools
import os
from typing import Final

from .linux import libc

TURNS: Final = 8
"""Turns from one free moment to the next."""


@functools.cache
def allowed() -> frozenset[int]:
    """Return the processors that this process may run on, as found before any is held."""
    return frozenset(os.sched_getaffinity(0))


class Caller:
    """The thread that asks; it is held from a turn's beginning to the end of a later one."""

    def __init__(self) -> None:
        self._allowed = allowed()
        self._here = -1
        self._turns = 0

    def begin(self) -> int:
        """Begin a turn on the processor whose number is returned."""
        if self._turns == 0:
            self._here = libc.sched_getcpu()
            os.sched_setaffinity(0, (self._here,))
        self._turns += 1
        return self._here

    def end(self) -> None:
        """End a turn."""
        if self._turns >= TURNS:
            self.free()

    def free(self) -> None:
        """Let this thread run anywhere again."""
        if self._turns > 0:
            os.sched_setaffinity(0, self._allowed)
            self._turns = 0


class Answerer:
    """The thread that answers."""

    def __init__(self) -> None:
        self._here = -1

    def follow(self, processor: int) -> None:
        """Go to the processor of who asks."""
        if processor != self._here:
            self._here = processor
            with contextlib.suppress(OSError):
                os.sched_setaffinity(0, (processor,))
