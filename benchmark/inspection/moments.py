"""The worst moment of a lift, and what the person was doing."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans import Played
from colift.benchmark.episode.drawn import shown_error
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import drawn_series
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.episode.trace import Series, Trace

Events = tuple[tuple[str, int], ...]
"""Name and first frame of each event of a plan, in order."""

STILL: Final = 0.005
"""Speed of the human's end below which it stands still [m/s]."""


@dataclass(frozen=True, kw_only=True)
class Moment:
    """A moment of a lift."""

    frame: int
    """Counted from 0."""
    error_mm: float
    """The error that pictures show, with its sign; see :func:`.shown_error`."""
    human_human_mm: float | None
    """That of two people at the same time; None if their lift had ended."""
    doing: str
    """What the person was doing."""

    @property
    def time_s(self) -> float:
        """Time since the beginning of the lift, at the end of the frame [s]."""
        return (self.frame + 1) * FRAME


def events_of(scenario: Scenario, seed: int) -> Events:
    """Return the events of the person's plan; none in a live lift, whose plan nobody knows."""
    if isinstance(scenario.human, Played):
        return ()
    return scenario.human.plan(scenario.subject, derive_seed(seed, f"plan/{scenario.name}")).events


def error_of(scenario: Scenario, trace: Trace) -> Series:
    """Return the error that pictures of a lift show (n,) [m]."""
    return shown_error(drawn_series(scenario.task.metrics), trace)


def worst_moment(
    episode: Episode, scenario: Scenario, events: Events, human_human: Trace
) -> Moment | None:
    """Return the moment of the largest error of a lift, or that of its failure.

    Parameters
    ----------
    episode, scenario
        The lift.
    events
        See :func:`events_of`.
    human_human
        The lift of two people.

    Returns
    -------
    Moment or None
        None if the lift ended before its first frame.
    """
    error, theirs = (error_of(scenario, trace) for trace in (episode.trace, human_human))
    if not len(error):
        return None
    frame = len(error) - 1 if episode.failure is not None else int(np.argmax(np.abs(error)))
    return Moment(
        frame=frame,
        error_mm=1000 * float(error[frame]),
        human_human_mm=1000 * float(theirs[frame]) if frame < len(theirs) else None,
        doing=_doing(episode.trace, events, frame),
    )


def _doing(trace: Trace, events: Events, frame: int) -> str:
    """Return the last event of the person's plan, the time since then, and the movement."""
    speed = float(trace.human_velocity[frame])
    way = "up" if speed > 0 else "down"
    moves = f"{way} at {1000 * abs(speed):.0f} mm/s" if abs(speed) > STILL else "still"
    begun = [each for each in events if each[1] <= frame]
    if not begun:
        return moves
    name, first = begun[-1]
    return f"{name.replace('_', ' ')}, {(frame - first) * FRAME:.2f} s in; {moves}"
