"""The signature of a network: its inputs and outputs, the observation, the action and the state."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from ..agent import RobotObservation
from ..errors import InputError
from .allowed import MOST_OBSERVATION, MOST_STATE
from .libraries import import_library

onnx = import_library("onnx")

_SHOWN: Final = 60

TYPES: Final = {
    onnx.TensorProto.FLOAT: np.float32,
    onnx.TensorProto.DOUBLE: np.float64,
    onnx.TensorProto.INT32: np.int32,
    onnx.TensorProto.INT64: np.int64,
    onnx.TensorProto.BOOL: np.bool_,
}
"""Types of numbers that tensors may have."""

FLOATS: Final = (onnx.TensorProto.FLOAT, onnx.TensorProto.DOUBLE)
"""Types of the inputs and outputs."""


@dataclass(frozen=True, kw_only=True)
class Port:
    """An input or output of a network."""

    name: str
    kind: int
    """Type of its numbers, as in the file."""
    shape: tuple[int, ...]

    @property
    def dtype(self) -> type:
        """Type of its numbers, as NumPy names it."""
        return TYPES[self.kind]


def quoted(name: str) -> str:
    """Return a name from a file in quotes, shortened to fit into a message."""
    return repr(name if len(name) <= _SHOWN else f"{name[:_SHOWN]}...")


def port(value: Any) -> Port:
    """Return an input or output with its shape.

    Raises
    ------
    InputError
        If it is not a tensor of floats, or its shape is not fixed.
    """
    where = quoted(value.name)
    tensor = value.type.tensor_type
    if value.type.WhichOneof("value") != "tensor_type" or tensor.elem_type not in FLOATS:
        raise InputError(
            f"has the input or output {where}, which is not a tensor of float or double"
        )
    sizes = tuple(int(each.dim_value) for each in tensor.shape.dim)
    if not tensor.HasField("shape") or min(sizes, default=1) <= 0:
        shown = ", ".join(str(d.dim_value or d.dim_param or "?") for d in tensor.shape.dim)
        raise InputError(
            f"has {where} with the shape [{shown[:_SHOWN]}]: every size must be a number"
        )
    return Port(name=value.name, kind=tensor.elem_type, shape=sizes)


def observation_of(inputs: Sequence[Any]) -> Port:
    """Return the first input; raise InputError if it is no observation, or there are too many."""
    if not 1 <= len(inputs) <= 2:
        names = ", ".join(quoted(value.name) for value in inputs[:5]) or "none"
        raise InputError(
            f"has the inputs {names}; it must have the observation, and may have a state"
        )
    found, least = port(inputs[0]), len(RobotObservation)
    size = found.shape[-1] if found.shape else 0
    if found.shape not in ((size,), (1, size)) or not least <= size <= MOST_OBSERVATION:
        raise InputError(
            f"has the observation {quoted(found.name)} with the shape {list(found.shape)}; it must "
            f"be [n] or [1, n], with n = {least} for a level table, and {least} to "
            f"{MOST_OBSERVATION} for other tasks"
        )
    return found


def state_of(inputs: Sequence[Any]) -> Port | None:
    """Return the second input, if there is one; raise InputError if it is not a state."""
    if len(inputs) == 1:
        return None
    found = port(inputs[1])
    if math.prod(found.shape) > MOST_STATE:
        raise InputError(
            f"has the state {quoted(found.name)} with the shape {list(found.shape)}; at most "
            f"{MOST_STATE} numbers are allowed"
        )
    return found


def outputs_of(inputs: Sequence[Any], outputs: Sequence[Any]) -> tuple[str, ...]:
    """Return the names of the outputs; raise InputError if there are not as many as inputs."""
    names = tuple(value.name for value in outputs)
    if len(names) != len(inputs):
        shown = ", ".join(map(quoted, names[:5])) or "none"
        wanted = "the action" if len(inputs) == 1 else "the action and the new state"
        raise InputError(f"has the outputs {shown}; with its inputs it must have {wanted}")
    return names
