"""A LeRobot data set, format v3.0: Parquet files with a row for each step, and JSON.

The layout is that of ``codebase_version`` v3.0 of https://github.com/huggingface/lerobot: many
episodes per file, and tables of episodes and tasks in ``meta/``. Numbers are single precision
there, as its models expect them. LeRobot keeps no observation after the last step.
"""

import json
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
from colift.agents.agent import RobotObservation
from colift.base.errors import InputError
from colift.benchmark.export.library import import_pyarrow
from colift.benchmark.export.lifts import ExportedLift
from colift.benchmark.export.provenance import Provenance
from numpy.typing import NDArray

VERSION: Final = "v3.0"
CHUNK_SIZE: Final = 1000
"""Files per chunk, which is a folder."""
FILE_MB: Final = 100
"""Largest data file that LeRobot's own writer makes [MB]."""
MOST_ROWS: Final = 200_000
"""Rows after which a new data file is begun; a file then has at most some 50 MB."""

FILE: Final = "chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"
DATA: Final = f"data/{FILE}"
EPISODES: Final = "meta/episodes/chunk-000/file-000.parquet"
INFO, STATS, TASKS = "meta/info.json", "meta/stats.json", "meta/tasks.parquet"

TASK: Final = "Keep the table level while a person lifts and lowers the other end."
"""The task in words, for policies with a language input."""

QUANTILES: Final = {"q01": 0.01, "q10": 0.1, "q50": 0.5, "q90": 0.9, "q99": 0.99}

Columns = dict[str, NDArray[Any]]


def frame_rate(provenance: Provenance) -> int:
    """Return the number of steps per second.

    Raises
    ------
    InputError
        If it is not a whole number, as LeRobot requires.
    """
    rate = 1 / provenance.control_period
    if abs(rate - round(rate)) > 1e-6:
        raise InputError(
            f"LeRobot needs a whole number of steps per second; a control period of "
            f"{provenance.control_period:g} s has {rate:g}: export to minari"
        )
    return round(rate)


def write_lerobot(folder: Path, lifts: Iterable[ExportedLift], provenance: Provenance) -> None:
    """Write lifts as a LeRobot data set into an empty folder.

    ``observation.state`` and ``action`` are the robot's, ``next.reward`` and ``next.done`` follow
    the step. With both agents, there are also ``human.observation`` and ``human.action``: names
    that no policy of LeRobot takes as its own input.

    Raises
    ------
    InputError
        If pyarrow is not installed, or the number of steps per second is not a whole number.
    """
    parquet = import_pyarrow("parquet")
    rate = frame_rate(provenance)
    rows: list[dict[str, Any]] = []
    whole: dict[str, list[NDArray[Any]]] = {}
    waiting: list[Columns] = []
    file, frames = 0, 0
    features: dict[str, dict[str, Any]] = {}

    def flush() -> None:
        """Write the waiting lifts into a data file."""
        joined = {name: np.concatenate([each[name] for each in waiting]) for name in waiting[0]}
        _write(parquet, folder / DATA.format(**_place(file)), joined)
        waiting.clear()

    for number, lift in enumerate(lifts):
        columns = _columns(lift, number, frames, rate)
        features = features or _features(lift, columns)
        if waiting and sum(len(each["index"]) for each in waiting) + lift.steps > MOST_ROWS:
            flush()
            file += 1
        waiting.append(columns)
        rows.append(_episode(lift, number, frames, file, columns))
        frames += lift.steps
        for name, values in columns.items():
            whole.setdefault(name, []).append(values)
    if not waiting:
        raise InputError("there is no lift with a step to export")
    flush()
    (folder / "meta").mkdir()
    _write_rows(parquet, folder / EPISODES, rows)
    _write_tasks(parquet, folder / TASKS)
    stats = {name: _stats(np.concatenate(parts)) for name, parts in whole.items()}
    (folder / STATS).write_text(json.dumps(stats, indent=4))
    info = {
        "codebase_version": VERSION,
        "robot_type": provenance.partner,
        "total_episodes": len(rows),
        "total_frames": frames,
        "total_tasks": 1,
        "chunks_size": CHUNK_SIZE,
        "data_files_size_in_mb": FILE_MB,
        "video_files_size_in_mb": FILE_MB,
        "fps": rate,
        "splits": {"train": f"0:{len(rows)}"},
        "data_path": DATA,
        "video_path": None,
        "features": features,
    }
    (folder / INFO).write_text(json.dumps(info, indent=4))


def _place(file: int) -> dict[str, int]:
    return {"chunk_index": file // CHUNK_SIZE, "file_index": file % CHUNK_SIZE}


def _columns(lift: ExportedLift, number: int, first: int, rate: int) -> Columns:
    """Return the columns of a lift, with a row for each step."""
    steps = np.arange(lift.steps)
    columns: Columns = {
        "observation.state": lift.robot.observations[:-1].astype(np.float32),
        "action": lift.robot.actions.astype(np.float32),
    }
    if lift.human is not None:
        columns["human.observation"] = lift.human.observations[:-1].astype(np.float32)
        columns["human.action"] = lift.human.actions.astype(np.float32)
        columns["human.reward"] = lift.human.rewards.astype(np.float32)
    return {
        **columns,
        "next.reward": lift.robot.rewards.astype(np.float32),
        "next.done": lift.terminations | lift.truncations,
        "timestamp": (steps / rate).astype(np.float32),
        "frame_index": steps,
        "episode_index": np.full(lift.steps, number),
        "index": first + steps,
        "task_index": np.zeros(lift.steps, np.int64),
    }


def _features(lift: ExportedLift, columns: Columns) -> dict[str, dict[str, Any]]:
    """Return the description of the columns in ``info.json``."""
    names: Mapping[str, list[str]] = {}
    if lift.robot.observations.shape[1] == len(RobotObservation):
        names = {
            "observation.state": [each.name.lower() for each in RobotObservation],
            "action": ["hand_command_change"],
        }
    return {
        name: {
            "dtype": str(values.dtype),
            "shape": [1] if values.ndim == 1 else list(values.shape[1:]),
            "names": names.get(name),
        }
        for name, values in columns.items()
    }


def _episode(
    lift: ExportedLift, number: int, first: int, file: int, columns: Columns
) -> dict[str, Any]:
    """Return the row of a lift in the table of episodes."""
    stats = {
        f"stats/{name}/{stat}": value
        for name, values in columns.items()
        for stat, value in _stats(values).items()
    }
    return {
        "episode_index": number,
        "tasks": [TASK],
        "length": lift.steps,
        **{f"data/{name}": value for name, value in _place(file).items()},
        "dataset_from_index": first,
        "dataset_to_index": first + lift.steps,
        **stats,
        "meta/episodes/chunk_index": 0,
        "meta/episodes/file_index": 0,
        "colift/scenario": lift.scenario,
        "colift/seed": str(lift.seed),
        "colift/policy": lift.policy,
        "colift/dropped": lift.dropped or "",
        "colift/failure": lift.failure or "",
        "colift/state": lift.state,
    }


def _stats(values: NDArray[Any]) -> dict[str, list[float] | list[int]]:
    """Return the statistics of a column, one number for each of its components."""
    table = values.reshape(len(values), -1).astype(np.float64)
    found: dict[str, list[float] | list[int]] = {
        "min": table.min(axis=0).tolist(),
        "max": table.max(axis=0).tolist(),
        "mean": table.mean(axis=0).tolist(),
        "std": table.std(axis=0).tolist(),
        "count": [len(values)],
    }
    quantiles = np.quantile(table, list(QUANTILES.values()), axis=0).tolist()
    return {**found, **dict(zip(QUANTILES, quantiles, strict=True))}


def _write(parquet: Any, path: Path, columns: Columns) -> None:
    arrow = import_pyarrow()
    path.parent.mkdir(parents=True, exist_ok=True)
    arrays = dict(_arrow_columns(arrow, columns))
    parquet.write_table(arrow.table(arrays), path, compression="snappy")


def _arrow_columns(arrow: Any, columns: Columns) -> Iterator[tuple[str, Any]]:
    """Yield the columns for Parquet: one number per row, or lists of the same length."""
    for name, values in columns.items():
        flat = arrow.array(values.reshape(-1))
        width = 1 if values.ndim == 1 else values.shape[1]
        yield name, flat if width == 1 else arrow.FixedSizeListArray.from_arrays(flat, width)


def _write_rows(parquet: Any, path: Path, rows: list[dict[str, Any]]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    parquet.write_table(import_pyarrow().Table.from_pylist(rows), path, compression="snappy")


def _write_tasks(parquet: Any, path: Path) -> None:
    """Write the table of tasks, whose index for pandas is the task in words."""
    arrow = import_pyarrow()
    kinds = {"task_index": ("int64", "int64"), "task": ("unicode", "object")}
    pandas = {
        "index_columns": ["task"],
        "column_indexes": [],
        "columns": [
            {
                "name": name,
                "field_name": name,
                "pandas_type": kind,
                "numpy_type": stored,
                "metadata": None,
            }
            for name, (kind, stored) in kinds.items()
        ],
    }
    table = arrow.table({"task_index": [0], "task": [TASK]})
    parquet.write_table(table.replace_schema_metadata({"pandas": json.dumps(pandas)}), path)
