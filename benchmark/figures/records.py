"""Records of the figures: the origin and the hashes of each, as they were when it was made."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Final

from colift.benchmark.figures.origins import Origin
from colift.benchmark.figures.registry import RecordedFigure

RECORDS: Final = "records.json"


@dataclass(frozen=True, kw_only=True)
class FigureRecord:
    """The origin of a figure and the SHA-256 of its files when it was made."""

    origin: Origin
    files: Mapping[str, str]


def read_records(folder: Path) -> dict[str, FigureRecord]:
    """Return the records of the figures in a folder, by name; empty without a file."""
    path = folder / RECORDS
    content = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    return {name: FigureRecord(**record) for name, record in content.items()}


def write_records(folder: Path, records: Mapping[str, FigureRecord], names: Iterable[str]) -> None:
    """Write the records of the registered figures, in their order; other records are dropped."""
    content = {name: asdict(records[name]) for name in names if name in records}
    text = json.dumps(content, indent=1) + "\n"
    (folder / RECORDS).write_text(text, encoding="utf-8")


def file_hashes(folder: Path, figure: RecordedFigure) -> dict[str, str]:
    """Return the SHA-256 of the files of a figure that exist."""
    paths = [folder / name for name in figure.files]
    return {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in paths if path.exists()
    }


def reasons_due(
    figure: RecordedFigure, origin: Origin, record: FigureRecord | None, files: Mapping[str, str]
) -> tuple[str, ...]:
    """Return the reasons to make a figure again; none if it is current.

    Parameters
    ----------
    figure
        The figure. A figure of the machine is due only if its command has changed or a file is
        missing.
    origin
        Its origin, as the code is now.
    record
        Its record.
    files
        The SHA-256 of its files, as they are now.
    """
    if record is None:
        return ("never made",)
    now = {name: value for name, value in origin.items() if name == "command" or not figure.machine}
    names = dict.fromkeys((*now, *(record.origin if not figure.machine else ())))
    changed = [name for name in names if now.get(name) != record.origin.get(name)]
    missing = [f"{name} missing" for name in figure.files if name not in files]
    edited = [f"{name} edited" for name in files if files[name] != record.files.get(name)]
    return (*changed, *missing, *edited)
