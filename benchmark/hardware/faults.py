"""What can go wrong in the emulated laboratory, on request."""

from dataclasses import dataclass
from typing import Final

from ...agents.errors import InputError

KINDS: Final = {
    "dropout": "the motion capture sends nothing",
    "nan": "the motion capture does not see the human's end (NaN)",
    "swap": "the motion capture takes the ends for each other",
    "drift": "the motion capture drifts upwards by VALUE m/s (default 0.05)",
    "latency": "the motion capture comes VALUE s later (default 0.25)",
    "jitter": "the motion capture comes up to VALUE s later, at random (default 0.05)",
    "disconnect": "the robot's connection is closed, for good",
    "silence": "the robot answers no call",
    "stream-end": "the stream is closed, for good",
    "motor-off": "the robot's motors lose their stiffness, for good",
}
"""The faults by name: what each does."""

DEFAULTS: Final = {"drift": 0.05, "latency": 0.25, "jitter": 0.05}
"""Values of the faults that have one."""


@dataclass(frozen=True, kw_only=True)
class Fault:
    """Something that goes wrong for a while."""

    kind: str
    start: float
    """When it begins, after the first lift was begun [s]."""
    duration: float
    """How long it lasts [s]."""
    value: float
    """How large it is; 0 for those that have no size."""

    def active(self, time: float) -> bool:
        """Return whether it goes wrong at a time after the first lift was begun [s]."""
        return self.start <= time < self.start + self.duration


def parse_fault(text: str) -> Fault:
    """Return the fault of ``KIND@START[:DURATION[:VALUE]]``; without a duration it stays.

    Raises
    ------
    InputError
        If there is no such fault, or a number is none.
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
