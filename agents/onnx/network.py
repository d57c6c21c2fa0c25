"""Checks of an ONNX file before any of it runs: its versions, contents, signature and sizes.

The file is parsed by the library ``onnx``, and a parsed network is one that can run.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from colift.agents.onnx.allowed import LARGEST, MOST_NODES, OPERATORS, OWN_DOMAINS
from colift.agents.onnx.batch import bind_batch, inputs_of
from colift.agents.onnx.libraries import import_library
from colift.agents.onnx.ports import TYPES, Shape, input_port, output_port, quoted
from colift.agents.onnx.signature import Signature, signature_of
from colift.agents.onnx.sizes import check_work, inferred_shapes
from colift.agents.onnx.versions import check_versions
from colift.base.errors import InputError

onnx = import_library("onnx")
numpy_helper = import_library("onnx.numpy_helper")
_message = import_library("google.protobuf.message")


@dataclass(frozen=True, kw_only=True)
class Network:
    """An ONNX file with a valid signature, of operators that are allowed."""

    name: str
    """Name of the file, for messages."""
    model: Any
    """The file as it is run, an ``onnx.ModelProto``: with a batch of 1, if it left that open."""
    signature: Signature
    batch: tuple[str, ...]
    """Names of the sizes that were bound to 1; empty if all sizes are numbers in the file."""


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
        If it is not an ONNX file, is too large, has other inputs and outputs than a policy,
        contains anything that is not allowed, is not a sound graph, or computes too much; the
        message names the fault.
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
    check_versions(model)
    _check_contents(model)
    batch = bind_batch(model.graph)
    inputs = [input_port(value) for value in inputs_of(model.graph)]
    if not inputs:
        raise InputError("has the inputs none; it must have the observation, and may have states")
    shapes = inferred_shapes(model)
    outputs = [output_port(value, shapes) for value in model.graph.output]
    signature = signature_of(inputs, outputs)
    check_work(model.graph, shapes)
    if batch:
        _declare(model.graph, shapes)
    return Network(name=name, model=model, signature=signature, batch=batch)


def _declare(graph: Any, shapes: Mapping[str, Shape]) -> None:
    """Replace the shapes that a file claims for what it computes by those that follow."""
    del graph.value_info[:]
    for value in graph.output:
        sizes = value.type.tensor_type.shape
        del sizes.dim[:]
        for size in shapes[value.name]:
            sizes.dim.add().dim_value = size


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
