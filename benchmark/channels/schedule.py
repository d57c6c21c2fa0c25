"""The order of events on a channel: it follows from the channel and the seed, not from the policy.

The robot is driven by time, the policy by messages (J. Nilsson, "Real-time control systems with
delays", Lund 1998): a policy acts when an observation arrives, never twice on the same one.
"""

import heapq
from collections.abc import Iterator
from dataclasses import dataclass

from colift.benchmark.channels.channel import Channel
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.links.delays import link_delays


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
        link_delays(link, derive_seed(seed, f"{name}/loss"), derive_seed(seed, f"{name}/jitter"))
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
