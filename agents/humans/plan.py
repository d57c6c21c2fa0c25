"""A plan: a person's intended height throughout an episode, and its assembly from segments."""

from dataclasses import dataclass
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np
from colift.agents.agent import FRAME, Agent
from colift.agents.humans.subject import Subject
from numpy.typing import NDArray

LENGTH_STEP = 10
"""A plan's length is a multiple of this many frames (0.1 s)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Plan:
    """A person's intention, private to that person.

    Starts and ends at rest at height 0 and is smooth: position, velocity and acceleration have no
    steps.
    """

    target: NDArray[np.float64]
    """(n,) intended height [m] of the human's end at the end of each frame, read-only."""
    strokes: tuple[tuple[int, int], ...]
    """First frame, and frame after the last, of each movement between two rests."""
    goal: float
    """The highest intended height [m]."""
    events: tuple[tuple[str, int], ...]
    """Name and first frame of each event, in order."""


class Behaviour(Protocol):
    """A way of lifting: parameters, and one pure function."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; the same arguments always give the same plan."""


@runtime_checkable
class Embodied(Protocol):
    """A behaviour whose plans are carried out by a person of its own, not a scripted human."""

    def person(self, subject: Subject) -> Agent:
        """Return the agent that carries out the plans of the behaviour."""


class Segment(NamedTuple):
    """A part of a plan."""

    name: str
    """Name of the event that the segment's first frame is."""
    heights: NDArray[np.float64]
    """Intended height [m] in each frame."""
    moving: bool
    """Whether the person moves; adjoining segments that move are one stroke."""


def still(name: str, height: float, duration: float) -> Segment:
    """Return a segment that stays at a height [m] for a time [s]."""
    return Segment(name, np.full(round(duration / FRAME), height), False)


def move(name: str, heights: NDArray[np.float64]) -> Segment:
    """Return a segment that moves through the heights [m]."""
    return Segment(name, heights, True)


def assemble(*segments: Segment) -> Plan:
    """Join segments into a plan; the last is extended to a multiple of ``LENGTH_STEP`` frames."""
    events: list[tuple[str, int]] = []
    strokes: list[tuple[int, int]] = []
    frame = 0
    for segment in segments:
        stop = frame + len(segment.heights)
        events.append((segment.name, frame))
        if segment.moving:
            start = strokes.pop()[0] if strokes and strokes[-1][1] == frame else frame
            strokes.append((start, stop))
        frame = stop
    missing = -frame % LENGTH_STEP
    tail = np.full(missing, segments[-1].heights[-1])
    target = np.concatenate([*(segment.heights for segment in segments), tail])
    target.flags.writeable = False
    return Plan(
        target=target, strokes=tuple(strokes), goal=float(target.max()), events=tuple(events)
    )
