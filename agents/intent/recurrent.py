"""A recurrent network that tells where a person means the robot's end to be: inputs and action."""

import io
import zipfile
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np

from ..control.portable import ArrayFunctions
from ..control.recurrent import GatedNetwork, gated
from ..errors import InputError
from ..observations import HapticObservation
from .pose_filter import FAR_STIFFNESS, TABLE_LENGTH, WRIST_STIFFNESS

AHEAD: Final = 1.2
"""Control periods that the straight line goes ahead, for the lag of the arm."""

REACH: Final = 0.1
"""Departure from a level table for an output of 1 [m]."""

INPUTS: Final = 8


class PoseMemory(NamedTuple):
    """What remains from step to step; each entry has a last axis of lifts, or none."""

    units: Any
    """(u, ...)"""
    near: Any
    """The last height of the human's end [m]."""
    command: Any
    """The command before the last one [m]."""


def pose_action(
    network: GatedNetwork, memory: PoseMemory, observation: Any, functions: ArrayFunctions
) -> tuple[PoseMemory, Any]:
    """Return the memory after a step, and the change of the command [m].

    With the height z of the human's end, which the torque tells (:func:`.touched`), and its last
    change d, the next command is

        z + AHEAD d + REACH * network(units, inputs).

    Parameters
    ----------
    network
        The weights.
    memory
        That of the last step.
    observation
        (7, ...) observations of :class:`.HapticObservation`.
    functions
        The library of the arrays.
    """
    hand, command = (
        observation[HapticObservation.HAND_HEIGHT],
        observation[HapticObservation.HAND_COMMAND],
    )
    force = observation[HapticObservation.FORCE]
    pitch = -observation[HapticObservation.TORQUE] / FAR_STIFFNESS
    near = hand - TABLE_LENGTH * pitch * (1.0 - pitch * pitch / 6.0)
    wrist = pitch + (FAR_STIFFNESS * pitch - force * TABLE_LENGTH) / WRIST_STIFFNESS
    rise = near - memory.near
    inputs = functions.stack(
        (
            50.0 * rise,
            10.0 * (near - 0.1),
            10.0 * (hand - 0.1),
            50.0 * (command - memory.command),
            20.0 * (command - hand),
            10.0 * pitch,
            10.0 * wrist,
            2.0 * force,
        )
    )
    units = gated(network, memory.units, inputs, functions)
    output = functions.product(network.output, functions.join((units, inputs)))
    departure = REACH * (output[0] + network.output_bias[0])
    wanted = near + AHEAD * rise + departure
    return PoseMemory(units, near, command), wanted - command


def pose_memory(network: GatedNetwork) -> PoseMemory:
    """Return the memory at the beginning of a lift."""
    return PoseMemory(np.zeros(network.units), 0.0, 0.0)


def read_pose_network(file: Path | Traversable) -> GatedNetwork:
    """Return the network of an ``.npz`` file.

    Raises
    ------
    InputError
        If the file cannot be read, or an array is missing, of a wrong shape, or not finite.
    """
    try:
        with np.load(io.BytesIO(file.read_bytes()), allow_pickle=False) as arrays:
            return pose_network(arrays, file.name)
    except (OSError, ValueError, EOFError, zipfile.BadZipFile) as error:
        raise InputError(f"{file.name}: not an .npz file of weights: {error}") from None


def pose_network(arrays: Any, source: str) -> GatedNetwork:
    """Return the network of named arrays, in double precision; errors as of the file's reader."""
    try:
        found = {name: np.asarray(arrays[name], dtype=np.float64) for name in GatedNetwork._fields}
    except (KeyError, ValueError, TypeError) as error:
        raise InputError(f"{source}: not the weights of a recurrent policy: {error}") from None
    units = found["memory"].shape[-1] if found["memory"].ndim == 2 else 0
    shapes = {
        "inputs": (3 * units, INPUTS),
        "memory": (3 * units, units),
        "bias": (3 * units,),
        "output": (1, units + INPUTS),
        "output_bias": (1,),
    }
    for name, shape in shapes.items():
        if units == 0 or found[name].shape != shape or not np.isfinite(found[name]).all():
            raise InputError(
                f"{source}: {name} must be finite and have the shape {shape}, got "
                f"{found[name].shape}"
            )
    return GatedNetwork(**found)
