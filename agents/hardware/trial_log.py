"""The log of a trial: every frame and step in order, as an object and as a CSV file.

The file is exact to the last bit. It has one row per event, in the order in which they came: a
``sample`` is a motion-capture frame, a ``step`` a control period, and the one ``trial`` row at the
top holds the trial's settings and outcome.
"""

import csv
import dataclasses
import io
import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, NamedTuple

from colift.agents.agent import FRAME
from colift.agents.hardware.ports import HandLimits, Sample
from colift.agents.hardware.stops import Stop
from colift.base.errors import InputError
from colift.base.text import decoded, read_bytes


class Step(NamedTuple):
    """One control period."""

    time: float
    """Start time [s]."""
    deadline: float
    """Scheduled start time [s]."""
    hand_height: float
    """Height of the hands by the encoders [m]."""
    set_point: float
    """Height of the hands by the robot's set-points [m]."""
    stiffness: float
    """Lowest stiffness of the arms' motors."""
    astray: float
    """Largest distance of a joint's set-point from the path of the commands [rad]."""
    hand_command: float
    """The command before this step [m]."""
    action: float
    """The policy's change of it [m]; NaN without an accepted action."""
    command: float
    """The command of this step [m]; unchanged when the hands are held."""
    hold: str
    """Reason for holding the hands; empty if they are not held."""
    sensing_age: float
    """Age of the newest motion-capture frame [s]."""
    rate: float
    """Motion-capture frames in the last second; infinite in the first second."""
    state_time: float
    """Time taken to read the robot [s]."""
    policy_time: float
    """Time spent waiting for the policy [s]."""
    command_time: float
    """Time taken to send the command [s]."""


@dataclass(kw_only=True)
class TrialLog:
    """Frames, steps and outcome of a trial, also of one that was stopped."""

    period: float
    """Control period [s]."""
    latency: float
    """Wanted time from the policy's motion-capture frame to the start of the hands' motion [s]."""
    begin: float = 0.0
    """Start of the loop [s], one period before the first step."""
    events: list[Sample | Step] = field(default_factory=list)
    """Frames and steps in the order of the loop."""
    late_steps: int = 0
    """Periods skipped because the loop was late."""
    stop: Stop | None = None
    """Kind of stop, or None if the trial reached its end."""
    reason: str = ""
    """Reason of the stop, in words."""

    @property
    def start(self) -> float:
        """Time of the first deadline [s]."""
        return self.begin + self.period

    @property
    def samples(self) -> list[Sample]:
        """The motion-capture frames."""
        return [event for event in self.events if isinstance(event, Sample)]

    @property
    def misdated(self) -> int:
        """Number of frames whose time stamps were ahead of the clock, or not numbers."""
        return sum(math.isnan(sample.time) for sample in self.samples)

    @property
    def steps(self) -> list[Step]:
        """The steps."""
        return [event for event in self.events if isinstance(event, Step)]


_TRIAL: Final = (
    "policy", "period", "latency", "begin", "late_steps", "low", "high", "speed",
    "tilt", "weight_offset", "dry", "stop", "reason",
)  # fmt: skip
COLUMNS: Final = ("event", *dict.fromkeys((*_TRIAL, *Sample._fields, *Step._fields)))
"""The columns; times in s, heights in m, speed in m/s."""


@dataclass(frozen=True, kw_only=True, eq=False)
class LoggedTrial:
    """A trial log with the settings needed to rerun it."""

    policy: str
    """The policy as the user named it."""
    limits: HandLimits
    """Limits to which the robot clipped its commands."""
    weight_offset: float
    """Offset added to every command for the sag under the table [m]."""
    dry: bool = False
    """Whether it was a dry run, without commands to the robot."""
    log: TrialLog
    """The log."""


FARTHEST: Final = 1e10
"""Largest size of a number; times of day are below."""

LONGEST: Final = 10.0
"""Longest control period and latency [s]."""

UNKNOWN: Final = ("action", "sensing_age", "rate")
"""Numbers of a step that may be infinite or NaN."""

LARGEST: Final = 256 * 1024 * 1024
"""Largest file of a trial [bytes]."""


def write_trial(path: Path, trial: LoggedTrial) -> None:
    """Write a trial; numbers read back to the same bits."""
    log = trial.log
    head = {
        "policy": trial.policy,
        "weight_offset": trial.weight_offset,
        "dry": int(trial.dry),
        **dataclasses.asdict(trial.limits),
        **{name: getattr(log, name) for name in ("period", "latency", "begin", "late_steps")},
        "stop": "" if log.stop is None else log.stop.name,
        "reason": log.reason,
    }
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerow({"event": "trial", **head})
        for event in log.events:
            kind = "step" if isinstance(event, Step) else "sample"
            writer.writerow({"event": kind, **event._asdict()})


def read_trial(path: Path) -> LoggedTrial:
    """Return the trial of a file.

    Raises
    ------
    InputError
        If it cannot be read, or is not a trial log.
    """
    text = decoded(read_bytes(path, LARGEST), str(path))
    try:
        return _trial(list(csv.DictReader(io.StringIO(text, newline=""))))
    except KeyError as error:
        raise InputError(f"{path} is not a trial log: it has no column {error}") from error
    except (ValueError, OverflowError, TypeError, IndexError, csv.Error) as error:
        raise InputError(f"{path} is not a trial log: {error!s:.200}") from error


def _trial(rows: list[dict[str, str]]) -> LoggedTrial:
    head, events = rows[0], rows[1:]
    if head["event"] != "trial":
        raise ValueError(f"the first row is {head['event']!r} instead of 'trial'")
    log = TrialLog(
        period=_number(head, "period", FRAME, LONGEST),
        latency=_number(head, "latency", 0.0, LONGEST),
        begin=_number(head, "begin"),
        late_steps=int(_number(head, "late_steps", 0.0)),
        events=list(_events(events)),
        stop=_stop(head["stop"]),
        reason=head["reason"],
    )
    limits = HandLimits(
        **{
            name: _number(head, name, -math.inf, math.inf)
            for name in ("low", "high", "speed", "tilt")
        }
    )
    return LoggedTrial(
        policy=head["policy"],
        limits=limits,
        weight_offset=_number(head, "weight_offset"),
        dry=bool(int(head["dry"])),
        log=log,
    )


def _stop(name: str) -> Stop | None:
    if name and name not in Stop.__members__:
        raise ValueError(f"stop is {name!r}, must be empty or one of {', '.join(Stop.__members__)}")
    return Stop[name] if name else None


def _number(
    row: dict[str, str], name: str, low: float = -FARTHEST, high: float = FARTHEST
) -> float:
    value = float(row[name])
    if not low <= value <= high:
        raise ValueError(f"{name} is {row[name]!r}, must be from {low:g} to {high:g}")
    return value


def _any_number(row: dict[str, str], name: str) -> float:
    """Return a number that may also be infinite or NaN."""
    return _number(row, name) if math.isfinite(float(row[name])) else float(row[name])


def _events(rows: list[dict[str, str]]) -> Iterable[Sample | Step]:
    last = -math.inf
    for row in rows:
        if row["event"] == "sample":
            yield Sample(*(_any_number(row, name) for name in Sample._fields))
        elif row["event"] == "step":
            values = {
                name: _any_number(row, name) if name in UNKNOWN else _number(row, name)
                for name in Step._fields
                if name != "hold"
            }
            step = Step(hold=row["hold"], **values)
            if step.time <= last:
                raise ValueError(f"a step's time goes from {last} s to {step.time} s")
            last = step.time
            yield step
        else:
            raise ValueError(f"unknown event {row['event']!r}")
