"""Bounds on a network's computation: the shape of every tensor, inferred before it runs."""

import math
from collections.abc import Callable, Mapping
from typing import Any

from colift.agents.onnx.allowed import LARGEST_SUM, LARGEST_TENSOR, RECURRENT
from colift.agents.onnx.libraries import import_library
from colift.agents.onnx.ports import Shape, one_line, quoted
from colift.base.errors import InputError

onnx = import_library("onnx")
checker = import_library("onnx.checker")
shape_inference = import_library("onnx.shape_inference")


def inferred_shapes(model: Any) -> dict[str, Shape]:
    """Return the shape of each tensor that is computed, and of the inputs and weights.

    They are inferred from those of its inputs and weights; the file's own claims about them are not
    trusted. Sizes that a graph computes are followed only if no other is too large: the time for
    that grows with them.

    Raises
    ------
    InputError
        If the graph is not sound, a shape does not follow from the inputs, or a tensor is too
        large.
    """
    bare = onnx.ModelProto()
    bare.CopyFrom(model)
    del bare.graph.value_info[:]
    for value in bare.graph.output:
        value.type.tensor_type.ClearField("shape")
    _sound(checker.check_model, model)
    _check_tensors(model.graph, _known(_sound(shape_inference.infer_shapes, bare)))
    options = {"check_type": True, "strict_mode": True, "data_prop": True}
    shapes = _known(_sound(shape_inference.infer_shapes, bare, **options))
    for node in model.graph.node:
        for name in filter(None, node.output):
            if name not in shapes:
                raise InputError(
                    f"has {quoted(name)} of {node.op_type}, whose shape does not follow from the "
                    "inputs: every size must be a number"
                )
    _check_tensors(model.graph, shapes)
    return {each.name: tuple(each.dims) for each in model.graph.initializer} | shapes


def _sound(function: Callable[..., Any], model: Any, **options: bool) -> Any:
    """Return what a function of onnx returns for a model; raise InputError if it refuses it."""
    try:
        return function(model, **options)
    except (
        checker.ValidationError,
        shape_inference.InferenceError,
        ValueError,
        RuntimeError,
    ) as error:
        reason = next(filter(None, map(str.strip, str(error).splitlines())), "")
        raise InputError(f"is not a sound graph: {one_line(reason, 200)}") from error


def _known(model: Any) -> dict[str, Shape]:
    """Return the shapes that were inferred and have no open size."""
    graph = model.graph
    found = {each.name: _shape(each) for each in (*graph.value_info, *graph.output, *graph.input)}
    return {name: shape for name, shape in found.items() if shape is not None}


def _shape(value: Any) -> Shape | None:
    tensor = value.type.tensor_type
    sizes = [each.dim_value if each.HasField("dim_value") else -1 for each in tensor.shape.dim]
    return tuple(sizes) if tensor.HasField("shape") and min(sizes, default=0) >= 0 else None


def check_work(graph: Any, shapes: Mapping[str, Shape]) -> None:
    """Check the work of a step, with the shapes of :func:`inferred_shapes`.

    Raises
    ------
    InputError
        If all tensors together, or those inside a recurrent operator, are too large.
    """
    total = 0
    for node in graph.node:
        total += sum(math.prod(shapes[name]) for name in filter(None, node.output))
        if node.op_type in RECURRENT:
            _check_recurrent(node, shapes)
    if total > LARGEST_SUM:
        raise InputError(f"computes {total} numbers in a step; at most {LARGEST_SUM} are allowed")


def _check_tensors(graph: Any, shapes: Mapping[str, Shape]) -> None:
    """Check the size of each tensor whose shape is known."""
    for node in graph.node:
        for name in node.output:
            if math.prod(shapes.get(name, ())) > LARGEST_TENSOR:
                raise InputError(
                    f"computes {quoted(name)} of {node.op_type} with the shape "
                    f"{list(shapes[name])}; at most {LARGEST_TENSOR} numbers are allowed"
                )


def _check_recurrent(node: Any, shapes: Mapping[str, Shape]) -> None:
    """Check the inner tensors: for each sample of the sequence, all gates of all units."""
    sequence, weights = (shapes.get(name, ()) for name in node.input[:2])
    inner = math.prod(sequence[:2]) * math.prod(weights[:2])
    if inner > LARGEST_TENSOR:
        raise InputError(
            f"computes {inner} numbers in a {node.op_type}; at most {LARGEST_TENSOR} are allowed"
        )
