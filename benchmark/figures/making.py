"""The making of figures: their commands, run in a folder of their own."""

import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from colift.base.errors import EvaluatorFault, InputError
from colift.benchmark.figures.changes import file_change
from colift.benchmark.figures.origins import origin_of
from colift.benchmark.figures.records import (
    FigureRecord,
    file_hashes,
    read_records,
    reasons_due,
    write_records,
)
from colift.benchmark.figures.registry import FOLDER, RecordedFigure, read_figures

COLUMNS: Final = 120
"""Width of the recorded tables [characters]."""

EXAMPLES: Final = "examples"
"""Folder of the clone that the commands refer to."""


@dataclass(frozen=True, kw_only=True)
class FigureStatus:
    """A figure, and the reasons to make it again."""

    figure: RecordedFigure
    reasons: tuple[str, ...]

    @property
    def due(self) -> bool:
        """Whether there is a reason."""
        return bool(self.reasons)


def statuses(root: Path) -> dict[str, FigureStatus]:
    """Return the status of each figure of a clone, by name."""
    folder = root / FOLDER
    records = read_records(folder)
    return {
        name: FigureStatus(
            figure=figure,
            reasons=reasons_due(
                figure, origin_of(figure, root), records.get(name), file_hashes(folder, figure)
            ),
        )
        for name, figure in read_figures(folder).items()
    }


def remake(root: Path, figure: RecordedFigure, recordings: Sequence[Path] = ()) -> list[str]:
    """Run the command of a figure, record its output, and return the changes; none if equal.

    Parameters
    ----------
    root
        The clone.
    figure
        The figure.
    recordings
        Files in place of the figure's recordings, in its order; further files are not used.

    Raises
    ------
    InputError
        If the figure needs more recordings.
    EvaluatorFault
        If the command fails, or a file is missing afterwards: nothing is recorded.
    """
    folder, origin = root / FOLDER, origin_of(figure, root)
    found = command_output(root, figure, recordings)
    changes = []
    for name, content in found.items():
        path = folder / name
        changes.append(file_change(name, path.read_bytes() if path.exists() else None, content))
        path.write_bytes(content)
    records = read_records(folder)
    records[figure.name] = FigureRecord(origin=origin, files=file_hashes(folder, figure))
    write_records(folder, records, read_figures(folder))
    return [change for change in changes if change]


def command_output(
    root: Path, figure: RecordedFigure, recordings: Sequence[Path] = ()
) -> dict[str, bytes]:
    """Run the command of a figure and return the content of its files, by name.

    The command runs in a new folder with the clone's ``examples`` and the recordings, with this
    interpreter's ``colift`` and ``python``, on a terminal of :data:`COLUMNS` without colour.
    Arguments and errors are as for :func:`remake`.
    """
    missing = figure.recordings[len(recordings) :]
    if missing:
        raise InputError(f"{figure.name} needs {', '.join(missing)}, which colift does not contain")
    with tempfile.TemporaryDirectory(prefix="colift-figure-") as made:
        place = Path(made)
        (place / EXAMPLES).symlink_to(root / EXAMPLES)
        for file, name in zip(recordings, figure.recordings, strict=False):
            shutil.copyfile(file, place / name)
        done = subprocess.run(
            ["bash", "-euc", figure.command],
            cwd=place,
            env=_environment(),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            check=False,
        )
        if done.returncode:
            raise EvaluatorFault(f"{figure.name}: its command ended with {done.returncode}")
        found = {f"{figure.name}.txt": done.stdout} if figure.text else {}
        for picture in figure.pictures:
            if not (place / picture).is_file():
                raise EvaluatorFault(f"{figure.name}: its command wrote no {picture}")
            found[Path(picture).name] = (place / picture).read_bytes()
        return found


def _environment() -> dict[str, str]:
    """Return the environment of a command: the same width everywhere, no colour, no window."""
    scripts = (sysconfig.get_path("scripts"), str(Path(sys.executable).parent))
    path = os.pathsep.join((*dict.fromkeys(scripts), os.environ.get("PATH", os.defpath)))
    kept = {name: value for name, value in os.environ.items() if name != "FORCE_COLOR"}
    fixed = {"COLUMNS": str(COLUMNS), "MPLBACKEND": "agg", "NO_COLOR": "1", "TERM": "dumb"}
    return {**kept, **fixed, "PATH": path}
