"""Checks of an ONNX file before anything of it runs: its format, its signature, its contents.

The file is parsed by the library ``onnx``. What it would compute is checked by :mod:`.sizes`.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from ..agent import RobotObservation
from ..errors import InputError
from .allowed import (
    IR_VERSIONS,
    LARGEST,
    MOST_NODES,
    MOST_STATE,
    OPERATORS,
    OPSETS,
    OWN_DOMAINS,
)
from .libraries import import_library

onnx = import_library("onnx")
numpy_helper = import_library("onnx.numpy_helper")
_message = import_library("google.protobuf.message")

_SHOWN: Final = 60

_TYPES: Final = {
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
        return _TYPES[self.kind]


@dataclass(frozen=True, kw_only=True)
class Network:
    """An ONNX file with a valid signature, of operators that are allowed."""

    name: str
    """Name of the file, for messages."""
    model: Any
    """The parsed file: an ``onnx.ModelProto``."""
    observation: Port
    state: Port | None
    """The state before a step, if the network has one."""
    outputs: tuple[str, ...]
    """Names of the action, and of the state after the step if there is one."""


def read_network(path: Path, shown: str = "") -> Network:
    """Return the network of a file.

    Parameters
    ----------
    path
        The file.
    shown
        Its name in messages; its own without it.

    Raises
    ------
    InputError
        If it is no ONNX file, is too large, has other inputs and outputs than a policy, or contains
        anything that is not allowed; the message names it.
    """
    shown = shown or path.name
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST + 1)
    except OSError as error:
        raise InputError(f"cannot read {shown}: {error.strerror}") from error
    try:
        return parse_network(data, shown)
    except InputError as error:
        raise InputError(f"{shown} {error}") from error


def parse_network(data: bytes, name: str) -> Network:
    """Return the network in the bytes of a file; see :func:`read_network`."""
    if len(data) > LARGEST:
        raise InputError(f"has more than {LARGEST // 2**20} MiB")
    try:
        model = onnx.ModelProto.FromString(data)
    except _message.DecodeError as error:
        raise InputError("is not an ONNX file") from error
    if not (model.ir_version and model.HasField("graph") and model.graph.node):
        raise InputError("is not an ONNX file: it has no graph")
    _check_versions(model)
    graph = model.graph
    _check_contents(model)
    weights = {tensor.name for tensor in graph.initializer}
    inputs = [value for value in graph.input if value.name not in weights]
    return Network(
        name=name,
        model=model,
        observation=_observation(inputs),
        state=_state(inputs),
        outputs=_outputs(inputs, graph.output),
    )


def quoted(name: str) -> str:
    """Return a name from a file in quotes, as much as fits into a message."""
    return repr(name if len(name) <= _SHOWN else f"{name[:_SHOWN]}...")


def _check_versions(model: Any) -> None:
    if model.ir_version not in IR_VERSIONS:
        raise InputError(
            f"has the IR version {model.ir_version}; {_among(IR_VERSIONS)} can be run: set "
            f"model.ir_version = {IR_VERSIONS[-1]} before it is saved"
        )
    versions = {each.domain: each.version for each in model.opset_import}
    for domain in versions:
        if domain not in OWN_DOMAINS:
            raise InputError(
                f"uses operators of the domain {quoted(domain)}; only ONNX's own are run"
            )
    version = next(iter(versions.values()), 0)
    if len(versions) != 1 or version not in OPSETS:
        raise InputError(f"has the opset {version}; {_among(OPSETS)} can be run: export it again")


def _among(versions: range) -> str:
    return f"{versions[0]} to {versions[-1]}"


def _check_contents(model: Any) -> None:
    graph = model.graph
    for what, found in (
        ("functions", model.functions),
        ("training information", model.training_info),
        ("sparse weights", graph.sparse_initializer),
    ):
        if found:
            raise InputError(f"has {what}, which are not allowed")
    if len(graph.node) > MOST_NODES:
        raise InputError(f"has {len(graph.node)} operators; at most {MOST_NODES} are allowed")
    for tensor in graph.initializer:
        _check_tensor(tensor, f"the weights {quoted(tensor.name)}")
    for node in graph.node:
        _check_node(node)


def _check_node(node: Any) -> None:
    if node.domain not in OWN_DOMAINS:
        raise InputError(
            f"uses the operator {quoted(node.op_type)} of the domain {quoted(node.domain)}; only "
            "ONNX's own are run"
        )
    if node.op_type not in OPERATORS:
        raise InputError(f"uses the operator {quoted(node.op_type)}, which is not allowed")
    for attribute in node.attribute:
        where = f"the attribute {quoted(attribute.name)} of {node.op_type}"
        kinds = onnx.AttributeProto
        if attribute.ref_attr_name or attribute.type in (kinds.GRAPH, kinds.GRAPHS):
            raise InputError(f"has a subgraph or a reference in {where}, which is not allowed")
        if attribute.type == kinds.TENSOR:
            _check_tensor(attribute.t, where)
        elif attribute.type not in (
            *(kinds.FLOAT, kinds.FLOATS, kinds.INT, kinds.INTS, kinds.STRING, kinds.STRINGS),
        ):
            raise InputError(f"has {where}, whose type is not allowed")


def _check_tensor(tensor: Any, where: str) -> None:
    if tensor.external_data or tensor.data_location == onnx.TensorProto.EXTERNAL:
        raise InputError(f"has {where} in another file: save all data in one")
    if tensor.data_type not in _TYPES:
        raise InputError(f"has {where}, whose type is not float, double, int32, int64 or bool")
    # Whatever a shape says, there are no more numbers than bytes.
    if any(size < 0 for size in tensor.dims) or math.prod(tensor.dims) > LARGEST:
        raise InputError(f"has {where} of the shape {list(tensor.dims)[:8]}")
    try:
        values = numpy_helper.to_array(tensor)
    except (ValueError, TypeError, OverflowError) as error:
        raise InputError(f"has {where}, whose data are not of its shape and type") from error
    if values.dtype.kind == "f" and np.isnan(values).any():
        raise InputError(f"has NaN in {where}")


def port(value: Any) -> Port:
    """Return an input or output with its shape.

    Raises
    ------
    InputError
        If it is no tensor of floats, or its shape is not fixed.
    """
    where = quoted(value.name)
    tensor = value.type.tensor_type
    if value.type.WhichOneof("value") != "tensor_type" or tensor.elem_type not in FLOATS:
        raise InputError(f"has the input or output {where}, which is no tensor of float or double")
    sizes = tuple(int(each.dim_value) for each in tensor.shape.dim)
    if not tensor.HasField("shape") or min(sizes, default=1) <= 0:
        shown = ", ".join(str(d.dim_value or d.dim_param or "?") for d in tensor.shape.dim)
        raise InputError(
            f"has {where} with the shape [{shown[:_SHOWN]}]: every size must be a number"
        )
    return Port(name=value.name, kind=tensor.elem_type, shape=sizes)


def _observation(inputs: Sequence[Any]) -> Port:
    if not 1 <= len(inputs) <= 2:
        names = ", ".join(quoted(value.name) for value in inputs[:5]) or "none"
        raise InputError(f"has the inputs {names}; it must have the observation, and may a state")
    found, size = port(inputs[0]), len(RobotObservation)
    if found.shape not in ((size,), (1, size)):
        raise InputError(
            f"has the observation {quoted(found.name)} with the shape {list(found.shape)}; it must "
            f"be [{size}] or [1, {size}]"
        )
    return found


def _state(inputs: Sequence[Any]) -> Port | None:
    if len(inputs) == 1:
        return None
    found = port(inputs[1])
    if math.prod(found.shape) > MOST_STATE:
        raise InputError(
            f"has the state {quoted(found.name)} with the shape {list(found.shape)}; at most "
            f"{MOST_STATE} numbers are allowed"
        )
    return found


def _outputs(inputs: Sequence[Any], outputs: Sequence[Any]) -> tuple[str, ...]:
    names = tuple(value.name for value in outputs)
    if len(names) != len(inputs):
        shown = ", ".join(map(quoted, names[:5])) or "none"
        wanted = "the action" if len(inputs) == 1 else "the action and the new state"
        raise InputError(f"has the outputs {shown}; with its inputs it must have {wanted}")
    return names
