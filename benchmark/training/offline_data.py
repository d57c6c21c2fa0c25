"""Data for offline learning: the steps of a Minari data set, as inputs of networks."""

import hashlib
import importlib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from colift.agents.actions import action_limit
from colift.agents.agent import RobotObservation
from colift.agents.submissions.offline.policy import Window
from colift.base.errors import InputError, error_text
from colift.base.extras import how_to_install
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.tasks.level.task import LEVEL
from numpy.typing import NDArray

FILES: Final = "data"
"""Folder of Minari's files in that of a data set."""

Single = NDArray[np.float32]


@dataclass(frozen=True, kw_only=True, eq=False)
class OfflineData:
    """All n steps of a data set, in single precision."""

    name: str
    """Name of the set."""
    lifts: int
    inputs: Single
    """(n, 22) inputs of :class:`.Window` before each step, divided by ``deviation``."""
    actions: Single
    """(n, 1) changes of the command, relative to the largest one, in [-1, 1]."""
    rewards: Single
    """(n,) rewards [m]."""
    coming: Single
    """(n, 22) inputs after each step."""
    ended: Single
    """(n,) 1 after a step that dropped the table, which ends the lift; else 0."""
    centre: NDArray[np.float64]
    """(22,) mean of the inputs [m]."""
    deviation: NDArray[np.float64]
    """(22,) their standard deviation [m]."""
    digest: str
    """SHA-256 (16 hexadecimal digits) over all arrays."""

    @property
    def steps(self) -> int:
        """Number of steps, n."""
        return len(self.actions)


def read_data(folder: Path) -> OfflineData:
    """Return the steps of a Minari data set.

    Parameters
    ----------
    folder
        A folder of ``colift export``, or any with Minari's files.

    Raises
    ------
    InputError
        If Minari is not installed, there is no such set, its spaces are not the robot's, a lift has
        arrays of other shapes or numbers that are not finite, or there is no step.
    """
    try:
        importlib.import_module("h5py")
        minari = importlib.import_module("minari")
    except ImportError as error:
        raise InputError(f"data sets need Minari: {how_to_install('export')}") from error
    place = folder / FILES if (folder / FILES).is_dir() else folder
    if not (place / "metadata.json").is_file():
        raise InputError(
            f"{folder}: no Minari data set: there is no metadata.json; see colift export"
        )
    try:
        lifts = minari.MinariDataset(place.absolute())
        _check_spaces(folder, lifts.observation_space, lifts.action_space)
        parts = [_steps(folder, lift) for lift in lifts]
    except InputError:
        raise
    except Exception as error:
        # A damaged file can raise anything.
        raise InputError(f"{folder}: a damaged data set: {error_text(error)}") from None
    if not sum(len(part["actions"]) for part in parts):
        raise InputError(f"{folder}: there is no step to learn from")
    return _joined(lifts.spec.dataset_id, parts)


def _check_spaces(folder: Path, observations: Any, actions: Any) -> None:
    """Refuse a set with observations or actions other than the robot's."""
    low, high = LEVEL.robot_bounds()
    limit = action_limit(CONTROL_PERIOD)
    for kind, space, bounds in (
        ("observations", observations, (low, high)),
        ("actions", actions, (np.array([-limit]), np.array([limit]))),
    ):
        shape = getattr(space, "shape", None)
        same = shape == bounds[0].shape and all(
            np.allclose(one, other)
            for one, other in zip((space.low, space.high), bounds, strict=True)
        )
        if not same:
            raise InputError(
                f"{folder}: its {kind} are not the robot's, {bounds[0].shape} within the bounds of "
                f"the environment: {space!r:.200}; colift export --view robot makes such sets"
            )


def _steps(folder: Path, lift: Any) -> dict[str, NDArray[Any]]:
    """Return the arrays of a lift, checked; with the inputs before each step and after the last."""
    where, steps = f"{folder}: lift {lift.id}", len(lift.rewards)
    due = {
        "observations": (steps + 1, len(RobotObservation)),
        "actions": (steps, 1),
        "rewards": (steps,),
        "terminations": (steps,),
    }
    for name, shape in due.items():
        array = np.asarray(getattr(lift, name))
        if array.shape != shape:
            raise InputError(f"{where}: {name} have the shape {array.shape}, must be {shape}")
        if not np.isfinite(array).all():
            step = int(np.argwhere(~np.isfinite(array))[0][0])
            raise InputError(f"{where}: {name} are not finite in step {step}")
    return {
        "inputs": windows(lift.observations),
        "actions": np.asarray(lift.actions),
        "rewards": np.asarray(lift.rewards),
        "ended": np.asarray(lift.terminations, dtype=np.float64),
    }


def windows(observations: Iterable[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Return the inputs of :class:`.Window` after each observation of a lift."""
    window = Window()
    window.reset()
    return np.array([window(observation) for observation in observations])


def _joined(name: str, parts: list[dict[str, NDArray[Any]]]) -> OfflineData:
    before = np.concatenate([part["inputs"][:-1] for part in parts])
    after = np.concatenate([part["inputs"][1:] for part in parts])
    centre, deviation = before.mean(axis=0), before.std(axis=0) + 1e-6
    limit = action_limit(CONTROL_PERIOD)
    actions = np.concatenate([part["actions"] for part in parts]) / limit
    arrays = (before, actions, after, *(part[n] for n in ("rewards", "ended") for part in parts))
    sha = hashlib.sha256(b"".join(np.ascontiguousarray(each, "<f8").tobytes() for each in arrays))
    return OfflineData(
        digest=sha.hexdigest()[:16],
        name=name,
        lifts=len(parts),
        inputs=((before - centre) / deviation).astype(np.float32),
        actions=np.clip(actions, -1.0, 1.0).astype(np.float32),
        rewards=np.concatenate([part["rewards"] for part in parts]).astype(np.float32),
        coming=((after - centre) / deviation).astype(np.float32),
        ended=np.concatenate([part["ended"] for part in parts]).astype(np.float32),
        centre=centre,
        deviation=deviation,
    )
