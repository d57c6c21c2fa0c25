"""A session on disk: one bundle for each lift, a line for each event, and recordings.

``recordings.csv`` has the hand's references of all complete lifts, which are scaled and smoothed
when played, like any recording; a session's folder itself is played unchanged, see
:mod:`.scenarios`.
"""

import csv
import io
import json
import re
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from colift.agents.agent import FRAME
from colift.agents.humans.recordings import COLUMNS
from colift.base.errors import InputError
from colift.benchmark.bundle import results, write_bundle
from colift.benchmark.bundle.files import RECORDINGS, RESULTS
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.runner import Run

LIFTS: Final = "lifts"
"""Folder of the lifts in that of a session."""

EVENTS: Final = "events.jsonl"
"""Lines about lifts that did not count, faults, arrivals and departures."""

MOST_PARTS: Final = 100
"""Most messages in which a page may report on a lift; each is short."""

SESSION: Final = "session.json"
"""File with the web process's data on the session."""


class SessionFolder:
    """The lifts of a session, written when they end: a room that dies loses only the present one.

    Parameters
    ----------
    path
        The session's folder; it is made if there is none.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        (path / LIFTS).mkdir(parents=True, exist_ok=True)

    def lifts(self) -> list[Path]:
        """Return the bundles of the finished lifts, in order."""
        return lift_folders(self.path)

    def next_number(self) -> int:
        """Return the number of the next lift, from 1."""
        return max((int(path.name.partition("-")[0]) for path in self.lifts()), default=0) + 1

    def played_with(self, partner: str) -> int:
        """Return the number of finished lifts with a partner."""
        return sum(path.name.partition("-")[2] == folder_name(partner) for path in self.lifts())

    def save(self, number: int, partner: str, run: Run) -> Path:
        """Write the bundle of a lift, all or nothing, and return its folder."""
        folder = self.path / LIFTS / f"{number:03d}-{folder_name(partner)}"
        write_bundle(folder, run, results(run, {}).plain())
        self._record(run.episodes[0])
        return folder

    def _record(self, episode: Episode) -> None:
        """Add a complete lift to the recordings of the session."""
        path = self.path / RECORDINGS
        if episode.failure is not None:
            return
        text = io.StringIO(path.read_text() if path.is_file() else "")
        text.seek(0, io.SEEK_END)
        writer = csv.writer(text, lineterminator="\n")
        if not text.tell():
            writer.writerow(COLUMNS)
        for frame, height in enumerate(episode.trace.human_action.ravel().tolist(), 1):
            writer.writerow((episode.trial, f"{frame * FRAME:.2f}", f"{height:.6f}"))
        _replace(path, text.getvalue())

    def timing(self, lift: Path, late: Sequence[float]) -> None:
        """Write the lateness of each frame of a lift [s], beside its bundle."""
        rounded = [round(1000 * each, 3) for each in late]
        _beside(lift).write_text(json.dumps({"room": {"late_ms": rounded}}) + "\n")

    def report(self, lift: Path, seat: int, content: Mapping[str, Any]) -> None:
        """Add a page's report on a lift, part by part, to its times.

        Raises
        ------
        InputError
            If a page sends more than :data:`MOST_PARTS` parts.
        """
        beside = _beside(lift)
        reports = json.loads(beside.read_text())
        parts = reports.setdefault(f"seat_{seat}", [])
        if len(parts) >= MOST_PARTS:
            raise InputError(f"a lift has at most {MOST_PARTS} reports of a page")
        parts.append(content)
        _replace(beside, json.dumps(reports) + "\n")

    def event(self, kind: str, **content: Any) -> None:
        """Append an event with the time of day [s since 1970]."""
        line = json.dumps({"time": round(time.time(), 3), "event": kind, **content})
        with (self.path / EVENTS).open("a", encoding="utf-8") as file:
            file.write(line + "\n")


def _beside(lift: Path) -> Path:
    """Return the file of a lift's times."""
    return lift.with_name(f"{lift.name}.times.json")


def _replace(path: Path, text: str) -> None:
    """Write a file anew, all or nothing: it is read while a lift is under way."""
    new = path.with_suffix(".new")
    new.write_text(text)
    new.replace(path)


def folder_name(name: str) -> str:
    """Return a partner's name as part of a folder's."""
    return re.sub(r"[^A-Za-z0-9._]+", "_", name).strip("._")[:80] or "partner"


def is_session(path: Path) -> bool:
    """Return whether a path is the folder of a session.

    One that has never had a room has no folder of lifts yet, but its data.
    """
    return (path / LIFTS).is_dir() or (path / SESSION).is_file()


def sessions_in(path: Path) -> list[Path]:
    """Return the sessions directly in a folder, by name; none if it cannot be read."""
    try:
        return sorted(filter(is_session, path.iterdir()))
    except OSError:
        return []


def lift_folders(path: Path) -> list[Path]:
    """Return the bundles of a session's finished lifts, in the order in which they were made.

    Raises
    ------
    InputError
        If it is not a session.
    """
    if not is_session(path):
        raise InputError(f"{path}: not a session of live lifts: it has no folder {LIFTS}")
    found = (path / LIFTS).glob("[0-9]*-*/")
    return sorted(folder for folder in found if (folder / RESULTS).is_file())
