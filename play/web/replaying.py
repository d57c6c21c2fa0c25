"""Replays of live lifts, made in a process of their own: the web process must never wait."""

import asyncio
import ctypes
import multiprocessing
import os
import signal
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any, Final

from colift.agents.humans import Played
from colift.base.errors import InputError
from colift.benchmark.bundle import read_bundle
from colift.leaderboard.replays.replay import play_ghost, replay_content
from colift.play.rooms.scenarios import ghost_scenario

WAITING: Final = 8
"""Number of replays that may wait to be made."""

NICENESS: Final = 10
"""Priority of the process that makes them: behind every room."""

PR_SET_PDEATHSIG: Final = 1
"""Option of prctl(2)."""


def live_replay(bundle: Path) -> dict[str, Any]:
    """Return the replay of a live lift, in the form of :func:`.replay_content`.

    Its ghost is a team of two simulated people with the same cues.

    Raises
    ------
    InputError
        If the folder is not a bundle of a live lift.
    """
    lifted = read_bundle(bundle)
    suite = lifted.recipe.suite()
    (scenario,), (episode,) = suite.scenarios, lifted.episodes
    if not isinstance(scenario.human, Played) or scenario.human.cue is None:
        raise InputError(f"{bundle}: not the bundle of a live lift")
    number, _, name = bundle.name.partition("-")
    ghost = play_ghost(ghost_scenario(scenario.human.cue, int(number)), episode.seed)
    content = replay_content(episode, scenario, ghost, policy=name)
    content["ghost"]["team"] = True
    if not scenario.seat.is_robot:
        content["command"] = []  # The actions are heights of a hand.
    return content


class Replays:
    """A maker of replays, one at a time, in a process that starts when it is first needed."""

    def __init__(self) -> None:
        self._pool: ProcessPoolExecutor | None = None
        self._asked = 0

    @property
    def full(self) -> bool:
        """Whether the queue is full."""
        return self._asked >= WAITING

    async def make(self, bundle: Path) -> dict[str, Any]:
        """Return the replay of a lift.

        Raises
        ------
        InputError
            As :func:`live_replay`.
        """
        self._asked += 1
        try:
            try:
                return await self._made(bundle)
            except BrokenProcessPool:  # The process was killed.
                self.close()
                return await self._made(bundle)
        finally:
            self._asked -= 1

    def close(self) -> None:
        """End the process, if there is one."""
        if self._pool is not None:
            self._pool.shutdown(wait=False, cancel_futures=True)
            self._pool = None

    async def _made(self, bundle: Path) -> dict[str, Any]:
        if self._pool is None:
            self._pool = ProcessPoolExecutor(
                1, multiprocessing.get_context("spawn"), initializer=_prepare
            )
        loop = asyncio.get_running_loop()
        return await loop.run_in_executor(self._pool, live_replay, bundle)


def tether(number: signal.Signals) -> None:
    """Let the system send this process a signal when its parent ends for any reason."""
    ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, number)


def _prepare() -> None:
    tether(signal.SIGKILL)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(NICENESS)
