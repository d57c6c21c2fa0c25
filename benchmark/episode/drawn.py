"""Series that a task adds to a trace and that pictures of its lifts show."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.trace import Trace
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class DrawnSeries:
    """A series of :meth:`.Task.series` that pictures and replays of a lift show.

    A height [m] is drawn beside the two ends of the table, in the chart of heights and as a mark in
    the scene; a hurdle as a bar in both; a place as a ball on the table, and in a chart of its own.
    """

    name: str
    """Key in :attr:`.Trace.added`."""
    label: str
    """Its name in legends, such as ``"intended far end"``."""
    where: Literal["robot", "human", "place"] = "robot"
    """The end at which the height is marked; or ``place``, a place on the table: its distance from
    the middle towards the robot [m]."""
    goal: bool = False
    """Whether it is the intended height of the robot's end, or the intended place of the ball."""
    stay: float | None = None
    """Of a hurdle, the time for which both ends have to stay at its height [s]. A hurdle is open in
    the frames in which the series differs from the human's intention, :attr:`.Trace.target`. None
    for every other series."""


@dataclass(frozen=True, kw_only=True)
class DrawnHurdle:
    """A height that the table has to pass in a window of time, and how near it came."""

    label: str
    where: str
    height: float
    """[m]"""
    start: int
    """First frame of the window."""
    stop: int
    """The frame after its last."""
    stay: int
    """Frames of a stay."""
    nearest: int | None
    """First frame of the stay that is nearest to the height; None if no stay was possible."""
    missed: float | None
    """Root mean square distance of both ends in that stay [m]."""

    def open_at(self, frame: int) -> bool:
        """Return whether a frame is in the window."""
        return self.start <= frame < self.stop


def drawn_heights(drawn: Sequence[DrawnSeries]) -> tuple[DrawnSeries, ...]:
    """Return the heights that are there all the time: no places, no hurdles."""
    return tuple(each for each in drawn if each.where != "place" and each.stay is None)


def intended_far_end(drawn: Sequence[DrawnSeries]) -> DrawnSeries | None:
    """Return the height at which the robot's end should be, if the task has one."""
    return next((each for each in drawn if each.goal and each.where != "place"), None)


def ball_and_target(drawn: Sequence[DrawnSeries]) -> tuple[DrawnSeries, DrawnSeries] | None:
    """Return the place of the ball and its intended place, if the task has both."""
    there = {each.goal: each for each in drawn if each.where == "place"}
    return (there[False], there[True]) if len(there) == 2 else None


def shown_error(drawn: Sequence[DrawnSeries], trace: Trace) -> NDArray[np.float64]:
    """Return the error that pictures show (n,) [m].

    It is the distance of the ball from its intended place, or that of the robot's end from its goal
    or, in a task with neither, the height difference of the ends.
    """
    both, goal = ball_and_target(drawn), intended_far_end(drawn)
    if both is not None:
        return np.asarray(trace.added[both[0].name] - trace.added[both[1].name])
    meant = trace.human_end if goal is None else trace.added[goal.name]
    return np.asarray(trace.robot_end - meant)


def is_scored(drawn: Sequence[DrawnSeries]) -> bool:
    """Return whether the error of :func:`shown_error` is the one that the task scores.

    Else it is the height difference of the ends, in a task that scores other distances.
    """
    goal = intended_far_end(drawn) or ball_and_target(drawn)
    return goal is not None or not drawn


def error_words(drawn: Sequence[DrawnSeries]) -> str:
    """Return a description of the error of :func:`shown_error`."""
    both, goal = ball_and_target(drawn), intended_far_end(drawn)
    if both is not None:
        return f"{both[0].label} from the {both[1].label}, towards the robot"
    return "robot's end above the " + ("human's" if goal is None else goal.label)


def drawn_hurdles(drawn: Sequence[DrawnSeries], trace: Trace) -> tuple[DrawnHurdle, ...]:
    """Return the hurdles of a lift, from the series that have a stay."""
    return tuple(
        _hurdle(each, round(each.stay / FRAME), window, trace)
        for each in drawn
        if each.stay is not None
        for window in _windows(trace.added[each.name], trace.target)
    )


def _windows(height: NDArray[np.float64], target: NDArray[np.float64]) -> list[slice]:
    """Return the runs of frames with one height that differs from the target."""
    other = height != target
    ends = (other[1:] != other[:-1]) | (other[1:] & (height[1:] != height[:-1]))
    bounds = [0, *(np.flatnonzero(ends) + 1).tolist(), len(height)]
    return [slice(start, stop) for start, stop in pairwise(bounds) if other[start:stop].any()]


def _hurdle(each: DrawnSeries, stay: int, window: slice, trace: Trace) -> DrawnHurdle:
    height = float(trace.added[each.name][window.start])
    ends = np.stack([trace.human_end[window], trace.robot_end[window]])
    squares = ((ends - height) ** 2).mean(axis=0)
    there = len(squares) >= stay
    means = sliding_window_view(squares, stay).mean(axis=-1) if there else np.empty(0)
    nearest = int(means.argmin()) if there else None
    return DrawnHurdle(
        label=each.label,
        where=each.where,
        height=height,
        start=window.start,
        stop=window.stop,
        stay=stay,
        nearest=None if nearest is None else window.start + nearest,
        missed=None if nearest is None else float(np.sqrt(means[nearest])),
    )
