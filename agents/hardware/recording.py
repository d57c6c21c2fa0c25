"""A trial as a CSV file, exact to the last bit, and back.

One row an event, in the order in which they came: a ``sample`` is a motion-capture frame, a
``step`` a control period, and the one ``trial`` row at the top says how it was played.
"""

import csv
import dataclasses
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from ..errors import InputError
from .ports import HandLimits, Sample
from .record import Record, Step
from .stops import Stop

_TRIAL: Final = (
    "policy", "period", "latency", "begin", "late_steps", "low", "high", "speed",
    "tilt", "weight_offset", "dry", "stop", "reason",
)  # fmt: skip
COLUMNS: Final = ("event", *dict.fromkeys((*_TRIAL, *Sample._fields, *Step._fields)))
"""The columns; times in s, heights in m, speed in m/s."""


@dataclass(frozen=True, kw_only=True, eq=False)
class TrialRecording:
    """A trial with what is needed to play it again."""

    policy: str
    """What was typed to name the policy."""
    limits: HandLimits
    """What the robot held its commands to."""
    weight_offset: float
    """What was added to every command for the sag under the table [m]."""
    dry: bool = False
    """Whether the commands went nowhere, and the set-points did not follow them."""
    record: Record
    """The trial."""


def write_recording(path: Path, recording: TrialRecording) -> None:
    """Write a trial; numbers are written so that they read back to the same bits."""
    record = recording.record
    head = {
        "policy": recording.policy,
        "weight_offset": recording.weight_offset,
        "dry": int(recording.dry),
        **dataclasses.asdict(recording.limits),
        **{name: getattr(record, name) for name in ("period", "latency", "begin", "late_steps")},
        "stop": "" if record.stop is None else record.stop.name,
        "reason": record.reason,
    }
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerow({"event": "trial", **head})
        for event in record.events:
            kind = "step" if isinstance(event, Step) else "sample"
            writer.writerow({"event": kind, **event._asdict()})


def read_recording(path: Path) -> TrialRecording:
    """Return the trial of a file.

    Raises
    ------
    InputError
        If it cannot be read, or is none.
    """
    try:
        with path.open(newline="") as file:
            rows = list(csv.DictReader(file))
        return _recording(rows)
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from error
    except (KeyError, ValueError, TypeError, IndexError) as error:
        raise InputError(f"{path} is no recording of a trial: {error}") from error


def _recording(rows: list[dict[str, str]]) -> TrialRecording:
    head, events = rows[0], rows[1:]
    if head["event"] != "trial":
        raise ValueError(f"it begins with {head['event']!r} instead of 'trial'")
    record = Record(
        period=float(head["period"]),
        latency=float(head["latency"]),
        begin=float(head["begin"]),
        late_steps=int(head["late_steps"]),
        events=list(_events(events)),
        stop=Stop[head["stop"]] if head["stop"] else None,
        reason=head["reason"],
    )
    limits = HandLimits(**{name: float(head[name]) for name in ("low", "high", "speed", "tilt")})
    return TrialRecording(
        policy=head["policy"],
        limits=limits,
        weight_offset=float(head["weight_offset"]),
        dry=bool(int(head["dry"])),
        record=record,
    )


def _events(rows: list[dict[str, str]]) -> Iterable[Sample | Step]:
    for row in rows:
        if row["event"] == "sample":
            yield Sample(*(float(row[name]) for name in Sample._fields))
        elif row["event"] == "step":
            values = {name: float(row[name]) for name in Step._fields if name != "hold"}
            yield Step(hold=row["hold"], **values)
        else:
            raise ValueError(f"unknown event {row['event']!r}")
