"""Series that a task adds to a trace and that pictures of its lifts show."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from colift.benchmark.episode.trace import Trace
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class DrawnSeries:
    """A series of :meth:`.Task.series` that pictures and replays of a lift show.

    A height [m] is drawn beside the two ends of the table, in the chart of heights and as a mark in
    the scene; a place is drawn as a ball on the table, and in a chart of its own.
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
