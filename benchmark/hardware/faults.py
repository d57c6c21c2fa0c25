"""Faults of the emulated laboratory, on request."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from colift.base.errors import InputError

KINDS: Final = {
    "dropout": "the motion capture sends no frames",
    "slow": "the motion capture sends only each VALUE-th frame (default 10)",
    "nan": "the motion capture does not see the human's end (NaN)",
    "freeze": "the motion capture repeats where the first VALUE markers were (default 4, all)",
    "unit-change": "the motion capture sends millimetres instead of metres",
    "future-stamps": "the motion capture's time stamps are VALUE s ahead (default 5)",
    "nan-stamps": "the motion capture's time stamps are not numbers",
    "past-stamps": "the motion capture's clock goes back by VALUE s (default 5)",
    "loss": "of the motion capture's frames, the share VALUE is lost, at random (default 0.3)",
    "duplicate": "of the motion capture's frames, the share VALUE comes twice (default 0.3)",
    "reorder": "the motion capture's frames overtake each other, by up to VALUE s (default 0.05)",
    "swap": "the motion capture takes the ends for each other",
    "drift": "the motion capture drifts upwards by VALUE m/s (default 0.05)",
    "latency": "the motion capture comes VALUE s later (default 0.25)",
    "jitter": "the motion capture comes up to VALUE s later, at random (default 0.05)",
    "disconnect": "the robot's connection is closed, for good",
    "silence": "the robot does not answer where its joints are",
    "hang": "the robot does not answer at all",
    "foreign-setpoint": "somebody else moves the left shoulder to VALUE rad (default 0.5)",
    "stream-end": "the stream is closed, for good",
    "motor-off": "the robot's motors have no stiffness",
    "hot": "the left elbow has VALUE degrees Celsius (default 76)",
    "battery": "the robot's battery has VALUE % left (default 10)",
    "breathing": "the robot breathes: both shoulders move by up to VALUE rad (default 0.05)",
    "idle-posture": "the robot has an idle posture switched on for its arms",
}
"""The faults by name, with their effects."""

DEFAULTS: Final = {
    "slow": 10.0, "freeze": 4.0, "future-stamps": 5.0, "drift": 0.05, "latency": 0.25,
    "jitter": 0.05, "foreign-setpoint": 0.5, "past-stamps": 5.0, "loss": 0.3, "duplicate": 0.3,
    "reorder": 0.05, "hot": 76.0, "battery": 10.0, "breathing": 0.05,
}  # fmt: skip
"""Values of the faults that have one."""


@dataclass(frozen=True, kw_only=True)
class Fault:
    """A fault, for a period of time."""

    kind: str
    start: float
    """Start of the fault [s], after the first lift or the request."""
    duration: float
    """Duration of the fault [s]."""
    value: float
    """Size of the fault; 0 for kinds without a size."""

    def active(self, time: float) -> bool:
        """Return whether the fault is active at a time [s]."""
        return self.start <= time < self.start + self.duration


def parse_fault(text: str) -> Fault:
    """Return the fault of ``KIND@START[:DURATION[:VALUE]]``; without a duration it remains.

    Raises
    ------
    InputError
        If there is no such fault, or a number is not valid.
    """
    kind, at, times = text.partition("@")
    if kind not in KINDS:
        raise InputError(f"unknown fault {kind!r}; known: {', '.join(KINDS)}")
    try:
        numbers = [float(number) for number in times.split(":")] if at else []
    except ValueError:
        numbers = []
    if not 1 <= len(numbers) <= 3 or not all(0 <= number < 1e6 for number in numbers):
        raise InputError(f"a fault is KIND@START[:DURATION[:VALUE]] in seconds, got {text!r}")
    defaults = [0.0, 1e6, DEFAULTS.get(kind, 0.0)]
    start, duration, value = numbers + defaults[len(numbers) :]
    return Fault(kind=kind, start=start, duration=duration, value=value)


class Schedule:
    """Faults over time: those planned from the first lift on, and those requested since.

    Parameters
    ----------
    planned
        Faults whose times count from the first lift.
    """

    def __init__(self, planned: Sequence[Fault] = ()) -> None:
        self._planned = tuple(planned)
        self._faults: list[Fault] = []

    def lift_begins(self, now: float) -> None:
        """Schedule the planned faults, if this is the first lift."""
        self._faults += [replace(fault, start=now + fault.start) for fault in self._planned]
        self._planned = ()

    def request(self, text: str, now: float) -> None:
        """Schedule a fault, whose time counts from now.

        Raises
        ------
        InputError
            As :func:`parse_fault`.
        """
        fault = parse_fault(text)
        self._faults.append(replace(fault, start=now + fault.start))

    def clear(self) -> None:
        """End all scheduled faults."""
        self._faults = []

    def active(self, now: float) -> list[Fault]:
        """Return the active faults; their ``start`` is on the same clock."""
        return [fault for fault in self._faults if fault.active(now)]
