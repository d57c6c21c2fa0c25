"""The inputs and outputs of a network: their names, types and shapes."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from colift.agents.onnx.allowed import MOST_STATE
from colift.agents.onnx.libraries import import_library
from colift.base.errors import InputError

onnx = import_library("onnx")

_SHOWN: Final = 60

Shape = tuple[int, ...]

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
    shape: Shape

    @property
    def dtype(self) -> type:
        """Type of its numbers, as NumPy names it."""
        return TYPES[self.kind]

    @property
    def form(self) -> tuple[Shape, int]:
        """Shape and type, which a state has before and after a step."""
        return self.shape, self.kind


def quoted(name: str) -> str:
    """Return a name from a file in quotes, shortened to fit into a message."""
    return repr(name if len(name) <= _SHOWN else f"{name[:_SHOWN]}...")


def one_line(text: str, length: int) -> str:
    """Return the beginning of a text that has parts of a file, without control characters."""
    return "".join(each if each.isprintable() else " " for each in text[:length])


def listed(ports: Sequence[Port]) -> str:
    """Return the names of inputs or outputs for a message."""
    names = ", ".join(quoted(each.name) for each in ports[:5])
    return f"{names}, ..." if len(ports) > 5 else names or "none"


def input_port(value: Any) -> Port:
    """Return an input, whose batch is bound (:mod:`.batch`).

    Raises
    ------
    InputError
        If it is not a tensor of floats, its shape is not fixed, or it is too large for a state: the
        time to infer other shapes from it would grow with its size.
    """
    kind = _kind(value)
    shape = value.type.tensor_type.shape
    sizes = tuple(int(each.dim_value) for each in shape.dim)
    if not value.type.tensor_type.HasField("shape") or min(sizes, default=1) <= 0:
        shown = ", ".join(str(each.dim_value or each.dim_param or "?") for each in shape.dim)
        raise InputError(
            f"has {quoted(value.name)} with the shape [{one_line(shown, _SHOWN)}]: every size must "
            "be a number, but the first of several, which is that of the batch; "
            "onnx.tools.update_model_dims.update_inputs_outputs_dims sets them"
        )
    if math.prod(sizes) > MOST_STATE:
        raise InputError(
            f"has the input {quoted(value.name)} with the shape {list(sizes)[:8]}; at most "
            f"{MOST_STATE} numbers are allowed"
        )
    return Port(name=value.name, kind=kind, shape=sizes)


def output_port(value: Any, shapes: Mapping[str, Shape]) -> Port:
    """Return an output with the shape that was inferred for its name.

    Raises
    ------
    InputError
        If it is not a tensor of floats, or nothing computes it.
    """
    if value.name not in shapes:
        raise InputError(f"has the output {quoted(value.name)}, which no operator computes")
    return Port(name=value.name, kind=_kind(value), shape=shapes[value.name])


def _kind(value: Any) -> int:
    """Return the type of an input's or output's numbers."""
    kind = int(value.type.tensor_type.elem_type)
    if value.type.WhichOneof("value") != "tensor_type" or kind not in FLOATS:
        raise InputError(
            f"has the input or output {quoted(value.name)}, which is not a tensor of float or "
            "double"
        )
    return kind
