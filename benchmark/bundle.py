"""The result bundle: a folder with a policy's scores, and all that they follow from."""

import csv
import hashlib
import io
import json
import math
import platform
import shutil
import tempfile
import zipfile
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ..agents.errors import InputError
from .episode import Episode
from .references import HUMAN_HUMAN, Reference
from .runner import Run
from .statistics import stratified_bootstrap
from .summary import group, summarise
from .trace import Trace

FILES: Final = ("results.json", "episodes.csv", "traces.npz", "manifest.json")
"""The files of a bundle; the manifest holds a hash of each of the others."""

LIBRARIES: Final = ("colift", "numpy", "pybullet")
"""Packages whose version can change a number."""


def results(run: Run, references: Mapping[str, Reference]) -> dict[str, Any]:
    """Return the content of ``results.json``.

    Parameters
    ----------
    run
        The policy's episodes.
    references
        Other agents on the same episodes, by name; see :mod:`.references`.
    """
    team = references.get(HUMAN_HUMAN)
    return {
        "colift": version("colift"),
        "suite": run.suite.name,
        "suite_digest": run.suite.digest,
        "complete": run.complete,
        "policy": {"name": run.policy, "digest": run.policy_digest},
        "summary": summarise(run.episodes, team.rmse_mm if team else None),
        "groups": group(run.episodes, team.by_cell() if team else None),
        "references": {name: _reference(value) for name, value in references.items()},
    }


def _reference(reference: Reference) -> dict[str, Any]:
    return {
        "rmse_mm": {
            "mean": reference.mean,
            "ci95": list(stratified_bootstrap(reference.rmse_mm, reference.cells)),
        },
        "sparc": {"mean": reference.sparc},
        "human_force_n": {"mean": reference.human_force_n},
    }


def check_target(folder: Path) -> None:
    """Refuse a folder that a bundle cannot be written to, before any work is done.

    Raises
    ------
    InputError
        If it holds something else than a bundle, or cannot be created or written to.
    """
    if folder.exists():
        if not folder.is_dir():
            raise InputError(f"--out must be a folder, {folder} is a file")
        others = sorted({path.name for path in folder.iterdir()} - set(FILES))
        if others:
            raise InputError(f"--out {folder} holds other things ({others[0]}); name a new folder")
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder.parent):
            pass
    except OSError as error:
        raise InputError(f"cannot write to {folder.parent}: {error.strerror}") from error


def write_bundle(folder: Path, run: Run, content: dict[str, Any]) -> None:
    """Write the bundle of a run: everything, or nothing.

    Equal runs give equal files, bit for bit, up to the step times in ``results.json``.

    Parameters
    ----------
    folder
        Where to; an older bundle there is replaced.
    run
        The episodes.
    content
        What :func:`results` returned.

    Raises
    ------
    InputError
        As :func:`check_target`.
    """
    check_target(folder)
    files = {
        "results.json": _json(content),
        "episodes.csv": _csv(run.episodes),
        "traces.npz": _npz(run.episodes),
    }
    manifest = {
        "versions": {name: version(name) for name in LIBRARIES},
        "python": platform.python_version(),
        "platform": platform.platform(),
        "suite": run.suite.name,
        "suite_digest": run.suite.digest,
        "seeds": list(run.suite.seeds),
        "traces": [episode.trace.digest() for episode in run.episodes],
        "sha256": {name: hashlib.sha256(data).hexdigest() for name, data in files.items()},
    }
    files["manifest.json"] = _json(manifest)
    with tempfile.TemporaryDirectory(dir=folder.parent) as temporary:
        made = Path(temporary) / "bundle"
        made.mkdir()
        for name, data in files.items():
            (made / name).write_bytes(data)
        if folder.exists():
            shutil.rmtree(folder)
        made.rename(folder)


def _json(content: dict[str, Any]) -> bytes:
    return (json.dumps(content, indent=2, allow_nan=False) + "\n").encode()


def _csv(episodes: Sequence[Episode]) -> bytes:
    """Return one row an episode; an empty field where there is no value."""
    text = io.StringIO()
    rows = [episode.row() for episode in episodes]
    writer = csv.DictWriter(text, fieldnames=list(rows[0]) if rows else [], lineterminator="\n")
    writer.writeheader()
    for row in rows:
        writer.writerow({k: "" if _missing(v) else v for k, v in row.items()})
    return text.getvalue().encode()


def _missing(value: object) -> bool:
    return isinstance(value, float) and math.isnan(value)


def _joined(parts: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    return np.concatenate(parts).astype("<f8") if parts else np.empty(0)


def _npz(episodes: Sequence[Episode]) -> bytes:
    """Return the traces as one zip of arrays, the episodes of each joined end to end.

    ``frames`` and ``steps`` (k,) say how many frames and steps each of the k episodes has;
    ``internals/NAME`` are what a policy reports of itself.
    """
    traces = [episode.trace for episode in episodes]
    arrays: dict[str, NDArray[Any]] = {
        "frames": np.array([len(trace.human_end) for trace in traces], dtype="<i8"),
        "steps": np.array([len(trace.action) for trace in traces], dtype="<i8"),
    }
    for name in Trace.series():
        arrays[name] = _joined([getattr(trace, name) for trace in traces])
    for name in sorted({name for trace in traces for name in trace.internals}):
        missing = [np.full(len(trace.action), math.nan) for trace in traces]
        parts = [
            trace.internals.get(name, none) for trace, none in zip(traces, missing, strict=True)
        ]
        arrays[f"internals/{name}"] = _joined(parts)
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays.items():
            # A fixed date, so that equal traces give equal files.
            entry = zipfile.ZipInfo(f"{name}.npy", date_time=(1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            with archive.open(entry, "w") as file:
                np.lib.format.write_array(file, array, allow_pickle=False)
    return data.getvalue()
