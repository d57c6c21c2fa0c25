"""The usual lift of a person: habits that a partner can learn, and one change of them."""

from typing import Final, NamedTuple

import numpy as np
from colift.agents.humans import GOAL_RANGE, Subject
from colift.agents.humans.movement import interpolate

WAYS: Final = ("straight", "stop", "dip", "turn")
"""Ways up: at once; with a stop; after a movement down; with a turn back."""

Range = tuple[float, float]

WAIT: Final[Range] = (0.6, 4.0)
"""Usual wait before a lift [s]."""
HOLD: Final[Range] = (0.2, 1.5)
"""Usual rest at the top [s]."""
HEIGHT: Final[Range] = (0.8, 1.2)
"""Usual height, relative to the person's mean."""
DURATION: Final[Range] = (0.85, 1.15)
"""Usual duration of the ways up and down, relative to the person's mean."""
AT: Final[Range] = (0.3, 0.75)
"""Place of a stop or a turn, relative to the height."""
LENGTH: Final[Range] = (0.4, 2.0)
"""Length of a stop [s]."""
SIZE: Final[Range] = (0.15, 0.5)
"""Way back after a turn, relative to the height reached; a dip is a tenth of it in metres."""

CHANGES: Final = range(4, 7)
"""Places of the lift from which on a habit is another one."""

CHANGING: Final = 0.6
"""Share of the people who change a habit."""

_SALT: Final = 0x0511A1


class UsualLift(NamedTuple):
    """The habits of one person; the ranges above are uniform, independent and assumed."""

    wait: float
    hold: float
    height: float
    """[m]"""
    up: float
    down: float
    """Durations [s]."""
    way: str
    """One of :data:`WAYS`."""
    at: float
    length: float
    size: float


ONSET: Final = ("wait", "hold")
GOAL: Final = ("height", "up", "down")
WAY: Final = ("way", "at", "length", "size")
"""Habits that change together."""


def usual_lift(subject: Subject, place: int) -> UsualLift:
    """Return a person's habits in a lift of a session; before and after one change, if any."""
    first, later, change = _habits(subject)
    return first if change is None or place < change else later


def usual_change(subject: Subject) -> int | None:
    """Return the place of the lift from which on a habit is another one; None if none is."""
    return _habits(subject)[2]


def _habits(subject: Subject) -> tuple[UsualLift, UsualLift, int | None]:
    """Return a person's habits before and after a change, and the change's place, if any."""
    rng = np.random.default_rng((_number(subject), _SALT))
    first, other = drawn_habits(subject, rng), drawn_habits(subject, rng)
    which, when, whether = rng.random(3).tolist()
    group = (ONSET, GOAL, WAY)[int(3 * which)]
    later = first._replace(**{name: getattr(other, name) for name in group})
    return first, later, CHANGES[int(when * len(CHANGES))] if whether < CHANGING else None


def drawn_habits(subject: Subject, rng: np.random.Generator) -> UsualLift:
    """Return habits drawn for a person's body."""
    wait, hold, height, up, down, way, at, length, size = rng.random(9).tolist()
    low, high = GOAL_RANGE
    return UsualLift(
        wait=interpolate(WAIT, wait),
        hold=interpolate(HOLD, hold),
        height=min(max(subject.amplitude * interpolate(HEIGHT, height), low), high),
        up=subject.duration * interpolate(DURATION, up),
        down=subject.duration * subject.lowering_ratio * interpolate(DURATION, down),
        way=WAYS[int(way * len(WAYS))],
        at=interpolate(AT, at),
        length=interpolate(LENGTH, length),
        size=interpolate(SIZE, size),
    )


def _number(subject: Subject) -> int:
    kind, _, number = subject.name.partition("-")
    return int(number) if kind == "draw" and number.isdecimal() else 0
