"""A recurrent network that corrects a straight line: inputs, memory and action."""

import io
import zipfile
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from colift.agents.agent import RobotObservation
from colift.agents.control.portable import ArrayFunctions
from colift.base.errors import InputError

STEPS_AHEAD: Final = 2.0
"""Control periods from the sample to the end of the next command, as in :class:`.Extrapolate`."""

ARM_BEHIND: Final = 0.2
"""Share of a command's change that the hand still has to make when the robot decides: the time
constant of the joints (20 ms) over the control period."""

SAG_GAIN: Final = 0.632
"""Gain per step of the filter of the measured sag: a time constant of one control period."""

CORRECTION: Final = 0.02
"""Correction of the command per unit of the network's output [m]."""

INPUTS: Final = 6

MOST_UNITS: Final = 4096


class GatedNetwork(NamedTuple):
    """The weights of u gated recurrent units (K. Cho et al., EMNLP 2014) and a linear output."""

    inputs: Any
    """(3 u, k) from the inputs to reset gate, update gate and candidate."""
    memory: Any
    """(3 u, u) from the units to the same."""
    bias: Any
    """(3 u,)"""
    output: Any
    """(1, u + k) from units and inputs to the correction."""
    output_bias: Any
    """(1,)"""

    @property
    def units(self) -> int:
        """Number of units."""
        return int(self.memory.shape[1])


class Memory(NamedTuple):
    """The state between steps; each entry has a last axis of lifts, or none."""

    units: Any
    """(u, ...)"""
    height: Any
    """The last seen height of the human's end [m]."""
    command: Any
    """The command before the last one [m]."""
    sag: Any
    """Filtered sag of the arms [m]."""
    begun: Any
    """1 after the first step, else 0."""


def act(
    network: GatedNetwork,
    memory: Memory,
    observation: Any,
    functions: ArrayFunctions,
    told: Any = None,
) -> tuple[Memory, Any]:
    """Return the memory after a step, and the change of the command [m].

    With the seen height x of the human's end, its change d since the last sample, the command c
    and the sag s, the next command is

        x + STEPS_AHEAD d + s + CORRECTION * network(units, inputs).

    Parameters
    ----------
    network
        The weights.
    memory
        The memory after the last step.
    observation
        (5, ...) observations of :class:`.RobotObservation`.
    functions
        The library of the arrays.
    told
        (k, ...) more inputs, of a network that is told more than a policy; None is none.
    """
    height = observation[RobotObservation.HUMAN_END]
    command = observation[RobotObservation.HAND_COMMAND]
    rise = (height - memory.height) * memory.begun
    change = (command - memory.command) * memory.begun
    measured = command - ARM_BEHIND * change - observation[RobotObservation.HAND_HEIGHT]
    sag = memory.sag + SAG_GAIN * (measured - memory.sag)
    inputs = functions.stack(
        (
            50.0 * rise,
            10.0 * (height - 0.1),
            50.0 * change,
            20.0 * (command - height),
            200.0 * sag,
            50.0 * (observation[RobotObservation.ROBOT_END] - height),
        )
    )
    if told is not None:
        inputs = functions.join((inputs, told))
    units = gated(network, memory.units, inputs, functions)
    output = functions.product(network.output, functions.join((units, inputs)))
    correction = output[0] + network.output_bias[0]
    wanted = height + STEPS_AHEAD * rise + sag + CORRECTION * correction
    begun = memory.begun * 0.0 + 1.0
    return Memory(units, height, command, sag, begun), wanted - command


def gated(network: GatedNetwork, units: Any, inputs: Any, functions: ArrayFunctions) -> Any:
    """Return the units (u, ...) after a step.

    With the logistic function S of reset gate r and update gate z,

        r = S(W_r x + U_r h + b_r),  z = S(W_z x + U_z h + b_z),
        h' = z h + (1 - z) tanh(W_c x + b_c + r (U_c h)).
    """
    count = network.units
    bias = network.bias.reshape(-1, *[1] * (inputs.ndim - 1))
    entering = functions.product(network.inputs, inputs) + bias
    kept = functions.product(network.memory, units)
    gates = 0.5 + 0.5 * functions.tanh(0.5 * (entering[: 2 * count] + kept[: 2 * count]))
    reset, update = gates[:count], gates[count:]
    candidate = functions.tanh(entering[2 * count :] + reset * kept[2 * count :])
    return update * units + (1.0 - update) * candidate


def memory_at_rest(network: GatedNetwork) -> Memory:
    """Return the memory at the beginning of a lift."""
    return Memory(np.zeros(network.units), 0.0, 0.0, 0.0, 0.0)


def network_of(arrays: Any, source: str, inputs: int = INPUTS, outputs: int = 1) -> GatedNetwork:
    """Return the network of named arrays with so many inputs and outputs, in double precision.

    Raises
    ------
    InputError
        If an array is missing, of a wrong shape, or not finite.
    """
    try:
        found = {name: np.asarray(arrays[name], dtype=np.float64) for name in GatedNetwork._fields}
    except (KeyError, ValueError, TypeError) as error:
        raise InputError(f"{source}: not the weights of a recurrent policy: {error}") from None
    memory = found["memory"]
    units = memory.shape[1] if memory.ndim == 2 else 0
    if not 1 <= units <= MOST_UNITS:
        raise InputError(
            f"{source}: it must have 1 to {MOST_UNITS} units, memory is {memory.shape}"
        )
    shapes = {
        "inputs": (3 * units, inputs),
        "memory": (3 * units, units),
        "bias": (3 * units,),
        "output": (outputs, units + inputs),
        "output_bias": (outputs,),
    }
    for name, shape in shapes.items():
        if found[name].shape != shape:
            raise InputError(
                f"{source}: {name} must have the shape {shape}, got {found[name].shape}"
            )
        if not np.isfinite(found[name]).all():
            raise InputError(f"{source}: {name} has numbers that are not finite")
    return GatedNetwork(**found)


def read_gated(file: Path | Traversable, inputs: int = INPUTS) -> GatedNetwork:
    """Return the network of an ``.npz`` file, with so many inputs.

    Raises
    ------
    InputError
        If the file cannot be read, or as :func:`network_of`.
    """
    try:
        with np.load(io.BytesIO(file.read_bytes()), allow_pickle=False) as arrays:
            return network_of(arrays, file.name, inputs)
    except (OSError, ValueError, EOFError, zipfile.BadZipFile) as error:
        raise InputError(f"{file.name}: not an .npz file of weights: {error}") from None


@cache
def shipped_network() -> GatedNetwork:
    """Return the network of the policy ``learned``, trained by ``colift train apg``."""
    return read_gated(files(__package__).joinpath("data", "learned.npz"))
