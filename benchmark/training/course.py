"""The course of a training: its folder, with settings, checkpoints, curves and trained policies.

::

    DIR/settings.json         trainer and settings; no other training may use the folder
    DIR/seed-0/               the trained policy, a submission
    DIR/seed-0.csv            its curve: error over steps and over seconds
    DIR/curves.svg            the curves of all seeds, and .pdf and .png, when they are trained
    DIR/seed-0.checkpoint.npz state from which an interrupted training resumes

Every file is replaced as a whole, so that a training may be killed at any time, and a full disk
leaves the last checkpoint as it was.
"""

import json
import os
import shutil
import zipfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from colift.base.errors import InputError
from numpy.typing import NDArray

OBSERVATION: Final = 1
"""Version of the robot's observation; see :class:`.RobotObservation`."""

SETTINGS: Final = "settings.json"

Arrays = Mapping[str, NDArray[Any]]


class Point(NamedTuple):
    """A point of a curve."""

    steps: int
    """Control steps played for learning so far."""
    seconds: float
    """Time of the training so far [s], interruptions left out."""
    rmse_mm: float
    """Mean RMSE of the policy on the validation lifts [mm]."""


@dataclass(frozen=True, kw_only=True)
class Course:
    """The part of one seed in the folder of a training."""

    folder: Path
    seed: int
    identity: Mapping[str, Any]
    """Trainer, observation version and settings."""
    curve: list[Point] = field(default_factory=list)
    """The points so far."""
    report: Callable[[Point], None] = lambda point: None
    """Called with each new point."""

    @property
    def policy(self) -> Path:
        """The folder of the trained policy: it exists when the training has ended."""
        return self.folder / f"seed-{self.seed}"

    @property
    def checkpoint(self) -> Path:
        """The file of the last checkpoint."""
        return self.folder / f"seed-{self.seed}.checkpoint.npz"

    def keep(self, point: Point, state: Arrays) -> None:
        """Add a point to the curve, and replace the checkpoint.

        Parameters
        ----------
        point
            The next point.
        state
            Everything from which the training continues.

        Raises
        ------
        InputError
            If a number is not finite, or a file cannot be written; the files are then unchanged.
        """
        for name, value in {**state, "rmse_mm": np.array(point.rmse_mm)}.items():
            check_finite(name, value)
        self.curve.append(point)
        content = BytesIO()
        identity = np.array(json.dumps(self.identity))
        curve = np.array(self.curve, dtype=np.float64).reshape(-1, len(Point._fields))
        arrays: dict[str, Any] = {"_identity": identity, "_curve": curve, **state}
        np.savez(content, **arrays)
        write_whole(self.checkpoint, content.getvalue())
        lines = (f"{steps},{seconds:.1f},{rmse:.3f}" for steps, seconds, rmse in self.curve)
        text = "\n".join([",".join(Point._fields), *lines]) + "\n"
        write_whole(self.folder / f"seed-{self.seed}.csv", text.encode())
        self.report(point)

    def load(
        self, shapes: Mapping[str, tuple[int, ...]] | None = None
    ) -> dict[str, NDArray[Any]] | None:
        """Return the state of the last checkpoint, and restore the curve; None if there is none.

        Parameters
        ----------
        shapes
            The arrays that the state must have; with None it is not checked.

        Raises
        ------
        InputError
            If the checkpoint is of another trainer, of other settings or of another version of the
            observation, has other arrays or numbers that are not finite, or is not readable.
        """
        if not self.checkpoint.exists():
            return None
        try:
            with self.checkpoint.open("rb") as file, np.load(file) as stored:
                state = {name: stored[name] for name in stored.files}
            identity = json.loads(str(state.pop("_identity")))
            curve = state.pop("_curve").tolist()
        except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
            raise InputError(f"{self.checkpoint}: not a checkpoint: {error}") from error
        _check_same(self.checkpoint, identity, self.identity)
        for name, shape in (shapes or {}).items():
            found = state[name].shape if name in state else "nothing"
            if found != shape:
                raise InputError(f"{self.checkpoint}: {name} must be {shape}, got {found}")
            check_finite(f"{name} of {self.checkpoint}", state[name])
        self.curve[:] = [Point(int(steps), *rest) for steps, *rest in curve]
        return state

    @property
    def seconds(self) -> float:
        """Time of the training up to the last point [s]."""
        return self.curve[-1].seconds if self.curve else 0.0

    @property
    def steps(self) -> int:
        """Steps of the training up to the last point."""
        return self.curve[-1].steps if self.curve else 0


def open_course(
    folder: Path,
    trainer: str,
    settings: Any,
    seed: int,
    report: Callable[[Point], None] = lambda point: None,
) -> Course:
    """Return the course of a training, new or to be resumed.

    Parameters
    ----------
    folder
        A new or empty folder, or that of the same training.
    trainer
        Its name.
    settings
        A dataclass of plain values: everything on which the result depends, except the seed.
    seed
        Its seed.
    report
        Called with each new point of its curve.

    Raises
    ------
    InputError
        If the folder holds anything else, or cannot be written to.
    """
    identity = {"trainer": trainer, "observation": OBSERVATION, **asdict(settings)}
    identity = json.loads(json.dumps(identity))
    path = folder / SETTINGS
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if not path.exists():
            if any(folder.iterdir()):
                raise InputError(
                    f"{folder} is not empty and not that of a training; name a new folder"
                )
            write_whole(path, (json.dumps(identity, indent=2) + "\n").encode())
        known = json.loads(path.read_text())
    except OSError as error:
        raise InputError(f"cannot use {folder}: {error.strerror}") from error
    except ValueError as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{path}: not the settings of a training: {error}") from error
    _check_same(path, known, identity)
    return Course(folder=folder, seed=seed, identity=identity, report=report)


def _check_same(path: Path, known: Any, wanted: Mapping[str, Any]) -> None:
    """Raise an InputError that names the first difference between two trainings."""
    if not isinstance(known, dict):
        raise InputError(f"{path}: not the settings of a training")
    for name in {**wanted, **known}:
        if known.get(name) != wanted.get(name):
            raise InputError(
                f"{path} is of another training: {name} is {known.get(name)}, not "
                f"{wanted.get(name)}; give the same settings, or another folder"
            )


def check_finite(name: str, value: NDArray[Any]) -> None:
    """Raise an InputError if an array holds NaN or infinity: the training has diverged."""
    if np.issubdtype(value.dtype, np.floating) and not np.isfinite(value).all():
        raise InputError(f"{name} has numbers that are not finite: the training has diverged")


def write_whole(path: Path, content: bytes) -> None:
    """Write a file, or leave it as it was.

    Raises
    ------
    InputError
        If it cannot be written.
    """
    partial = path.with_name(f".{path.name}.partial")
    try:
        try:
            with partial.open("wb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            partial.replace(path)
        finally:
            partial.unlink(missing_ok=True)
    except OSError as error:
        raise InputError(f"cannot write {path}: {error.strerror}") from error


def put_in_place(made: Path, folder: Path) -> None:
    """Move a complete folder to a place, replacing another there if any."""
    shutil.rmtree(folder, ignore_errors=True)
    made.replace(folder)


def write_summary(courses: Sequence[Course]) -> Path:
    """Write the last point of each course as a table, and return its file.

    Raises
    ------
    InputError
        If it cannot be written.
    """
    path = courses[0].folder / "summary.csv"
    rows = (f"{each.seed},{each.curve[-1].steps},{each.curve[-1].rmse_mm:.3f}" for each in courses)
    write_whole(path, ("\n".join(["seed,steps,rmse_mm", *rows]) + "\n").encode())
    return path
