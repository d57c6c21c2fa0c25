"""Bounds on a network's computation: the shape of every tensor, inferred before it runs."""

import math
from collections.abc import Mapping
from typing import Any

from ..errors import InputError
from .allowed import LARGEST_SUM, LARGEST_TENSOR, RECURRENT
from .libraries import import_library
from .ports import Shape, quoted

onnx = import_library("onnx")
checker = import_library("onnx.checker")
shape_inference = import_library("onnx.shape_inference")


def inferred_shapes(model: Any) -> dict[str, Shape]:
    """Return the shape of each tensor that is computed, and of the inputs and weights.

    They are inferred from those of its inputs and weights; the file's own claims about them are not
    trusted.

    Raises
    ------
    InputError
        If the graph is not sound, or a shape does not follow from the inputs.
    """
    bare = onnx.ModelProto()
    bare.CopyFrom(model)
    del bare.graph.value_info[:]
    for value in bare.graph.output:
        value.type.tensor_type.ClearField("shape")
    try:
        checker.check_model(model)
        known = shape_inference.infer_shapes(
            bare, check_type=True, strict_mode=True, data_prop=True
        ).graph
    except (
        checker.ValidationError,
        shape_inference.InferenceError,
        ValueError,
        RuntimeError,
    ) as error:
        reason = next(filter(None, map(str.strip, str(error).splitlines())), "")
        raise InputError(f"is not a sound graph: {reason[:200]}") from error
    values = (*known.value_info, *known.output, *known.input)
    found = {value.name: _shape(value) for value in values}
    shapes = {name: shape for name, shape in found.items() if shape is not None}
    for node in model.graph.node:
        for name in filter(None, node.output):
            if name not in shapes:
                raise InputError(
                    f"has {quoted(name)} of {node.op_type}, whose shape does not follow from the "
                    "inputs: every size must be a number"
                )
    return {each.name: tuple(each.dims) for each in model.graph.initializer} | shapes


def _shape(value: Any) -> Shape | None:
    tensor = value.type.tensor_type
    sizes = [each.dim_value if each.HasField("dim_value") else -1 for each in tensor.shape.dim]
    return tuple(sizes) if tensor.HasField("shape") and min(sizes, default=0) >= 0 else None


def check_work(graph: Any, shapes: Mapping[str, Shape]) -> None:
    """Check the sizes of all that a graph computes.

    Raises
    ------
    InputError
        If a tensor or all tensors together are too large.
    """
    total = 0
    for node in graph.node:
        for name in filter(None, node.output):
            size = math.prod(shapes[name])
            total += size
            if size > LARGEST_TENSOR:
                raise InputError(
                    f"computes {quoted(name)} of {node.op_type} with the shape "
                    f"{list(shapes[name])}; at most {LARGEST_TENSOR} numbers are allowed"
                )
        if node.op_type in RECURRENT:
            _check_recurrent(node, shapes)
    if total > LARGEST_SUM:
        raise InputError(f"computes {total} numbers in a step; at most {LARGEST_SUM} are allowed")


def _check_recurrent(node: Any, shapes: Mapping[str, Shape]) -> None:
    """Check the inner tensors: for each sample of the sequence, all gates of all units."""
    sequence, weights = (shapes.get(name, ()) for name in node.input[:2])
    inner = math.prod(sequence[:2]) * math.prod(weights[:2])
    if inner > LARGEST_TENSOR:
        raise InputError(
            f"computes {inner} numbers in a {node.op_type}; at most {LARGEST_TENSOR} are allowed"
        )
