"""Bounds on a network's computation: the shape of every tensor, inferred before it runs."""

import math
from collections.abc import Mapping
from typing import Any, Final

from ..errors import InputError
from .allowed import LARGEST_SUM, LARGEST_TENSOR, RECURRENT
from .libraries import import_library
from .network import Network
from .signature import quoted

onnx = import_library("onnx")
checker = import_library("onnx.checker")
shape_inference = import_library("onnx.shape_inference")

ACTIONS: Final = ((), (1,), (1, 1))
"""Shapes of the action."""

Shape = tuple[int, ...]


def check_sizes(network: Network) -> None:
    """Check the shapes of all that a network computes.

    They are inferred from those of its inputs and weights; the file's own claims about them are not
    trusted.

    Raises
    ------
    InputError
        If the graph is not sound, a shape does not follow from the inputs, a tensor or all tensors
        together are too large, or the outputs do not have the shapes of an action and of the state.
    """
    try:
        shapes = _inferred(network.model)
        _check_outputs(network, shapes)
        weights = {each.name: tuple(each.dims) for each in network.model.graph.initializer}
        _check_work(network, {**weights, **shapes})
    except InputError as error:
        raise InputError(f"{network.name} {error}") from error


def _inferred(model: Any) -> dict[str, Shape]:
    """Return the shape of each tensor that is computed, and of the inputs."""
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
    return shapes


def _shape(value: Any) -> Shape | None:
    tensor = value.type.tensor_type
    sizes = [each.dim_value if each.HasField("dim_value") else -1 for each in tensor.shape.dim]
    return tuple(sizes) if tensor.HasField("shape") and min(sizes, default=0) >= 0 else None


def _check_outputs(network: Network, shapes: Mapping[str, Shape]) -> None:
    action, *after = network.outputs
    kinds = {each.name: each.type.tensor_type.elem_type for each in network.model.graph.output}
    if shapes.get(action) not in ACTIONS:
        raise InputError(
            f"has the action {quoted(action)} with the shape {list(shapes.get(action, ()))}; it "
            "must be [1]"
        )
    state = network.state
    if state is not None and (shapes.get(after[0]), kinds[after[0]]) != (state.shape, state.kind):
        raise InputError(
            f"has the new state {quoted(after[0])} with another shape or type than the state "
            f"{quoted(state.name)}, {list(state.shape)}"
        )


def _check_work(network: Network, shapes: Mapping[str, Shape]) -> None:
    total = 0
    for node in network.model.graph.node:
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
