"""The order of events on a channel: it follows from the channel and the seed, not from the policy.

The robot is driven by time, the policy by messages (J. Nilsson, "Real-time control systems with
delays", Lund 1998): a policy acts when an observation arrives, never twice on the same one.
"""

import heapq
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.channels.channel import Channel, Link
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seeding import derive_seed


@dataclass(frozen=True, kw_only=True)
class Turn:
    """The events between two steps of the robot."""

    seen: tuple[int, ...]
    """Steps of the observations that the policy acts on, in the order of their arrival: each is
    newer than all before."""
    answered: int | None
    """Step of the observation that the robot's new command answers; None if it has no new one."""


def channel_seed(scenario: Scenario, seed: int) -> int:
    """Return the seed of a channel in an episode."""
    return derive_seed(seed, f"channel/{scenario.name}")


def schedule(channel: Channel, frames: int, seed: int) -> Iterator[Turn]:
    """Yield the turn of each step, without end.

    In step k the robot sends observation k. If it is newer than all that have arrived before, the
    policy answers at once. At the beginning of each step the robot takes the answer to the newest
    observation among those that have arrived by then, unless it had a newer one before.

    Every delay is rounded to a whole number of frames, since the world moves by frames. A message
    that arrives in the frame in which a step begins is in time for it.

    Parameters
    ----------
    channel
        The channel.
    frames
        Frames per step.
    seed
        See :func:`channel_seed`. The seed and the link decide whether message k is lost or late,
        whatever happens to the others.
    """
    down, up = (
        _delays(link, derive_seed(seed, f"{name}/loss"), derive_seed(seed, f"{name}/jitter"))
        for name, link in (("down", channel.down), ("up", channel.up))
    )
    observations: list[tuple[int, int]] = []  # Heaps of the frame of arrival, and the step.
    answers: list[tuple[int, int]] = []
    back: list[int | None] = []  # Delay of the answer to each observation.
    seen = applied = -1
    step = 0
    while True:
        now = step * frames
        delay = next(down)
        back.append(next(up))
        if delay is not None:
            heapq.heappush(observations, (now + delay, step))
        calls = []
        for frame, number in _arrived(observations, now):
            if number > seen:
                seen = number
                calls.append(number)
                returns = back[number]
                if returns is not None:
                    heapq.heappush(answers, (frame + returns, number))
        newest = max((number for _, number in _arrived(answers, now)), default=-1)
        fresh = newest > applied
        applied = max(applied, newest)
        yield Turn(seen=tuple(calls), answered=newest if fresh else None)
        step += 1


def _arrived(heap: list[tuple[int, int]], now: int) -> Iterator[tuple[int, int]]:
    """Take from a heap everything that has arrived by a frame, the earliest first."""
    while heap and heap[0][0] <= now:
        yield heapq.heappop(heap)


def _delays(link: Link, loss_seed: int, jitter_seed: int) -> Iterator[int | None]:
    """Yield the delay of each message in frames; None if it is lost."""
    chance = np.random.default_rng(loss_seed)
    jitter = _jitter(link, np.random.default_rng(jitter_seed))
    lost = chance.random() < link.loss
    while True:
        frames = math.floor((link.delay + jitter()) / FRAME + 0.5)
        yield None if lost else frames
        lost = chance.random() < (1.0 - link.ends_burst if lost else link.begins_burst)


def _jitter(link: Link, rng: np.random.Generator) -> Callable[[], float]:
    """Return a function that draws a jitter [s]."""
    mean, deviation = link.jitter_mean, link.jitter_deviation
    if deviation == 0.0:
        return lambda: mean
    spread = (deviation / mean) ** 2
    if link.jitter == "gamma":
        return lambda: float(rng.gamma(1.0 / spread, mean * spread))
    variance = math.log1p(spread)
    return lambda: float(rng.lognormal(math.log(mean) - variance / 2, math.sqrt(variance)))
