"""Recorded lifts, read from a CSV file."""

import csv
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from ..errors import InputError

COLUMNS: Final = ("trial", "t_s", "z_m")

LEAST_MOVEMENT: Final = 0.01
"""Least range of the heights of a lift [m]."""

LARGEST_MOVEMENT: Final = 1e4
"""Largest range of the heights of a lift [m], in any plausible unit."""

LONGEST: Final = 120.0
"""Longest recording [s]; beyond it, the unit of time is wrong."""


@dataclass(frozen=True, kw_only=True)
class Recording:
    """The height of a person's hand over time, as recorded."""

    name: str
    """The trial."""
    times: tuple[float, ...]
    """Time of each sample [s], increasing, at any rate."""
    heights: tuple[float, ...]
    """Height at each time [m], from any origin."""

    def __post_init__(self) -> None:
        if len(self.times) != len(self.heights):
            raise InputError(
                f"trial {self.name!r}: {len(self.times)} times but {len(self.heights)} heights"
            )
        if len(self.times) < 2:
            raise InputError(
                f"trial {self.name!r} has {len(self.times)} sample(s), needs at least 2"
            )
        for before, after in zip(self.times, self.times[1:], strict=False):
            if not after > before:
                raise InputError(
                    f"trial {self.name!r}: time goes from {before} s to {after} s, must increase"
                )
        lasting = self.times[-1] - self.times[0]
        if lasting > LONGEST:
            raise InputError(
                f"trial {self.name!r} lasts {lasting:g} s, must be at most {LONGEST:g} s "
                "(is t_s in seconds?)"
            )
        span = max(self.heights) - min(self.heights)
        if span > LARGEST_MOVEMENT:
            raise InputError(
                f"trial {self.name!r}: its heights span {span:g} m, must be at most "
                f"{LARGEST_MOVEMENT:g} m (is z_m in metres?)"
            )
        if span < LEAST_MOVEMENT:
            raise InputError(
                f"trial {self.name!r} does not move: its heights span {span:.4f} m, must be at "
                f"least {LEAST_MOVEMENT} m (is z_m in metres?)"
            )


def load_recordings(path: str | Path) -> tuple[Recording, ...]:
    """Return the recordings of a CSV file with the columns ``trial,t_s,z_m``, in order.

    Other columns are ignored. Heights [m] may have any origin, times [s] any rate.

    Raises
    ------
    InputError
        When the file cannot be read, a column is missing, a value is not a number, or a trial is
        not a lift: time that does not increase, a single sample, less than 1 cm of movement.
    """
    samples: dict[str, tuple[list[float], list[float]]] = {}
    for trial, time, height in _rows(Path(path)):
        times, heights = samples.setdefault(trial, ([], []))
        times.append(time)
        heights.append(height)
    if not samples:
        raise InputError(f"{path}: no samples, needs rows of {','.join(COLUMNS)}")
    try:
        return tuple(
            Recording(name=trial, times=tuple(times), heights=tuple(heights))
            for trial, (times, heights) in samples.items()
        )
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def _rows(path: Path) -> Iterator[tuple[str, float, float]]:
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.DictReader(file)
            header = [name.strip() for name in reader.fieldnames or ()]
            missing = [name for name in COLUMNS if name not in header]
            if not header:
                raise InputError(f"{path}: empty file, needs the columns {','.join(COLUMNS)}")
            if missing:
                hint = "" if len(header) > 1 else " (are the columns separated by commas?)"
                raise InputError(
                    f"{path}: missing column(s) {', '.join(missing)}; found {', '.join(header)}"
                    f"{hint}"
                )
            reader.fieldnames = header
            for row in reader:
                where = f"{path}, line {reader.line_num}"
                trial = (row["trial"] or "").strip()
                if not trial:
                    raise InputError(f"{where}: trial is empty, must name the trial")
                yield trial, _number(row, "t_s", where), _number(row, "z_m", where)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path}: not a CSV file in UTF-8: {error}") from None


def _number(row: dict[str, str], column: str, where: str) -> float:
    text = row[column]
    try:
        value = float(text)
    except (TypeError, ValueError):
        raise InputError(f"{where}: {column} is {text!r}, must be a number") from None
    if not math.isfinite(value):
        raise InputError(f"{where}: {column} is {text!r}, must be finite")
    return value
