"""The CSV file of lifts: notes on their origin, then a row for each sample."""

import csv
import io
import re
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path

from colift.agents.humans import load_recordings
from colift.agents.humans.recording_notes import CITE, LICENCE, MARK, Notes
from colift.agents.humans.recordings import COLUMNS, PERSON
from colift.base.errors import InputError
from colift.benchmark.recordings.takes import Take, Taken

PHASE = "phase"
"""Column of the part of the lift: ``rise``, ``hold`` or ``lower``; empty at rest."""

FAR = "z_far_m"
"""Column of the height of the other end [m]."""


def lifts_csv(takes: Sequence[Take], notes: Notes) -> bytes:
    """Return the file of all lifts of some takes, and check that colift reads it.

    Raises
    ------
    InputError
        If there is no lift, two have the same name, or :func:`.load_recordings` refuses them, as it
        does copies of one lift.
    """
    lifts = _named([(take, lift) for take in takes for lift in take.lifts])
    if not lifts:
        raise InputError("no lift is left: nothing is written")
    text = io.StringIO()
    for line in _notes(takes, notes):
        text.write(f"{MARK} {line}\n")
    writer = csv.writer(text, lineterminator="\n")
    people = any(lift.person for _, lift in lifts)
    phases = any(any(lift.phases) for _, lift in lifts)
    far = any(lift.far is not None for _, lift in lifts)
    trial, time, height = COLUMNS
    writer.writerow(
        [trial, *([PERSON] * people), time, height, *([PHASE] * phases), *([FAR] * far)]
    )
    for name, lift in lifts:
        for i, (seconds, metres) in enumerate(zip(lift.times, lift.heights, strict=True)):
            row = [name, *([lift.person] * people), f"{seconds:.6f}", f"{metres:.6f}"]
            row += [lift.phases[i]] * phases
            row += ["" if lift.far is None else f"{lift.far[i]:.6f}"] * far
            writer.writerow(row)
    data = text.getvalue().encode()
    _check(data)
    return data


def _check(data: bytes) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "lifts.csv"
        path.write_bytes(data)
        try:
            load_recordings(path)
        except InputError as error:
            reason = re.sub(r"^(, line \d+)?: ", "", str(error).removeprefix(str(path)))
            raise InputError(f"the lifts cannot be used together: {reason}") from None


def _notes(takes: Sequence[Take], notes: Notes) -> list[str]:
    """Return the lines on the origin of the lifts."""
    lines = ["made by 'colift recordings' from:"]
    for take in takes:
        if take.lifts:
            track, unit = take.track, take.motion.unit or "no unit stated"
            named = f", trial {take.motion.take}" if take.motion.take else ""
            lines.append(
                f"{take.file.name}{named}: {take.motion.kind}, {track.hand}, up {track.up}, "
                f"{unit}, {take.rate:.5g} Hz"
                + (f", {take.filled} samples filled" if take.filled else "")
            )
    lines += [f"{LICENCE}: {notes.licence}"] if notes.licence else []
    lines += [f"{CITE}: {notes.cite}"] if notes.cite else []
    return [" ".join(line.split()) for line in lines]


def joined_notes(found: Iterable[Notes], licence: str | None, cite: str | None) -> Notes:
    """Return the notes of several files, each once, with those that the user gave first."""
    several = [*found]
    licences = [licence or "", *(notes.licence for notes in several)]
    cites = [cite or "", *(notes.cite for notes in several)]
    return Notes(_joined(licences), _joined(cites))


def _joined(texts: Sequence[str]) -> str:
    """Return texts, each once and on one line."""
    return "; ".join(filter(None, dict.fromkeys(" ".join(text.split()) for text in texts)))


def _named(lifts: Sequence[tuple[Take, Taken]]) -> list[tuple[str, Taken]]:
    """Return the lifts with names of their own, with the people's or the folders' if needed."""
    names = [lift.trial for _, lift in lifts]
    if len(set(names)) < len(names):
        names = [f"{lift.person} {lift.trial}".strip() for _, lift in lifts]
    if len(set(names)) < len(names):
        names = [f"{take.file.parent.name}/{lift.trial}".lstrip("/") for take, lift in lifts]
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise InputError(
            f"two lifts are called {twice!r:.80}: was a file given twice? Give files names of "
            "their own"
        )
    return [(name, lift) for name, (_, lift) in zip(names, lifts, strict=True)]
