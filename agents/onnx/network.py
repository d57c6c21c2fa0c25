"""Checks of an ONNX file before any of it runs: its format and its contents.

The file is parsed by the library ``onnx``. The tensors that it would compute are checked by
:mod:`.sizes`.
"""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InputError
from .allowed import (
    IR_VERSIONS,
    LARGEST,
    MOST_NODES,
    OPERATORS,
    OPSETS,
    OWN_DOMAINS,
)
from .libraries import import_library
from .signature import TYPES, Port, observation_of, outputs_of, quoted, state_of

onnx = import_library("onnx")
numpy_helper = import_library("onnx.numpy_helper")
_message = import_library("google.protobuf.message")


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
        Its name in messages; by default its own.

    Raises
    ------
    InputError
        If it is not an ONNX file, is too large, has other inputs and outputs than a policy, or
        contains anything that is not allowed; the message names the fault.
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
        observation=observation_of(inputs),
        state=state_of(inputs),
        outputs=outputs_of(inputs, graph.output),
    )


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
    kinds = onnx.AttributeProto
    plain = (kinds.FLOAT, kinds.FLOATS, kinds.INT, kinds.INTS, kinds.STRING, kinds.STRINGS)
    for attribute in node.attribute:
        where = f"the attribute {quoted(attribute.name)} of {node.op_type}"
        if attribute.ref_attr_name or attribute.type in (kinds.GRAPH, kinds.GRAPHS):
            raise InputError(f"has a subgraph or a reference in {where}, which is not allowed")
        if attribute.type == kinds.TENSOR:
            _check_tensor(attribute.t, where)
        elif attribute.type not in plain:
            raise InputError(f"has {where}, whose type is not allowed")


def _check_tensor(tensor: Any, where: str) -> None:
    if tensor.external_data or tensor.data_location == onnx.TensorProto.EXTERNAL:
        raise InputError(f"has {where} in another file: save all data in one")
    if tensor.data_type not in TYPES:
        raise InputError(f"has {where}, whose type is not float, double, int32, int64 or bool")
    # A tensor cannot have more numbers than the file has bytes, whatever its shape claims.
    if any(size < 0 for size in tensor.dims) or math.prod(tensor.dims) > LARGEST:
        raise InputError(f"has {where} with the impossible shape {list(tensor.dims)[:8]}")
    try:
        values = numpy_helper.to_array(tensor)
    except (ValueError, TypeError, OverflowError) as error:
        raise InputError(f"has {where}, whose data are not of its shape and type") from error
    if values.dtype.kind == "f" and np.isnan(values).any():
        raise InputError(f"has NaN in {where}")
