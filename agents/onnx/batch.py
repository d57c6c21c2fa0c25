"""The batch of a network, which is one lift: a first size without a number becomes 1.

Exporters leave it open: PyTorch as a name such as ``batch``, tf2onnx as ``unk__6``, others as -1.
"""

from typing import Any


def bind_batch(graph: Any) -> tuple[str, ...]:
    """Set the batch of a graph's inputs to 1, in place, and return the names of their sizes.

    The batch is the first size of an input with two or more, if it has no number, and every other
    size of the same name. A size that is left open without a name is empty among the names.
    """
    shapes = [value.type.tensor_type.shape.dim for value in inputs_of(graph)]
    first = [sizes[0] for sizes in shapes if len(sizes) > 1 and _is_open(sizes[0])]
    names = tuple(dict.fromkeys(size.dim_param for size in first))
    named = [size for sizes in shapes for size in sizes if size.dim_param in filter(None, names)]
    for size in (*first, *named):
        size.dim_value = 1
    return names


def inputs_of(graph: Any) -> list[Any]:
    """Return the inputs of a graph without those that have weights as values."""
    weights = {tensor.name for tensor in graph.initializer}
    return [value for value in graph.input if value.name not in weights]


def _is_open(size: Any) -> bool:
    """Return whether a size is not a number; some exporters write -1 for that."""
    return not size.HasField("dim_value") or size.dim_value == -1
