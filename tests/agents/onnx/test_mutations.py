"""Damaged files: each is refused in words, or runs."""

import numpy as np
import pytest

pytest.importorskip("onnx", reason="needs onnx: uv sync --all-extras")
pytest.importorskip("onnxruntime", reason="needs onnxruntime: uv sync --all-extras")

import onnx
from colift.agents.onnx.allowed import OPERATORS
from colift.agents.onnx.policy import OnnxPolicy
from colift.base.errors import InputError

from .networks import FLOAT, proportional, recurrent

MUTATIONS = 60
"""Damaged files of each kind."""

SOURCES = [made.SerializeToString() for made in (proportional(FLOAT), recurrent())]
SIZES = [-(2**63), -1, 0, 1, 2, 5, 10**10]


def damaged_bytes(rng, data):
    """Return a file with some bytes exchanged, removed, added or copied."""
    content = bytearray(data)
    for _ in range(rng.integers(1, 6)):
        place, other = rng.integers(len(content), size=2)
        size = rng.integers(1, 9)
        match rng.integers(4):
            case 0:
                content[place] = rng.integers(256)
            case 1:
                del content[place : place + size]
            case 2:
                content[place:place] = rng.bytes(size)
            case 3:
                content[place : place + size] = content[other : other + size]
    return bytes(content)


def damaged_graph(rng, data):
    """Return a file that can be read, with other names, sizes, types or operators."""
    made = onnx.ModelProto.FromString(data)
    graph = made.graph
    names = [*(each.name for each in graph.input), "", "\x1b[31m", "x" * 500]
    names += [name for each in graph.node for name in (*each.input, *each.output)]
    for _ in range(rng.integers(1, 4)):
        node = graph.node[rng.integers(len(graph.node))]
        ports = [*graph.input, *graph.output]
        port = ports[rng.integers(len(ports))]
        name = names[rng.integers(len(names))]
        match rng.integers(8):
            case 0:
                node.op_type = sorted(OPERATORS)[rng.integers(len(OPERATORS))]
            case 1:
                node.input[rng.integers(len(node.input))] = name
            case 2:
                node.output[0] = name
            case 3:
                port.name = name
            case 4:
                for size in port.type.tensor_type.shape.dim:
                    size.dim_value = int(rng.choice(SIZES))
            case 5:
                for size in port.type.tensor_type.shape.dim:
                    size.dim_param = name
            case 6:
                port.type.tensor_type.elem_type = rng.integers(25)
            case 7:
                graph.initializer[0].data_type = rng.integers(25)
    return made.SerializeToString()


@pytest.mark.parametrize("damaged", [damaged_bytes, damaged_graph])
def test_a_damaged_file_is_refused_in_words_or_runs(tmp_path, damaged):
    told = []
    for seed in range(MUTATIONS):
        rng = np.random.default_rng(seed)
        path = tmp_path / "policy.onnx"
        path.write_bytes(damaged(rng, SOURCES[seed % len(SOURCES)]))
        try:
            policy = OnnxPolicy(str(path))
            policy.reset(0)
            policy.act(np.zeros(64))
        except InputError as error:
            told.append(str(error))
    assert len(told) > MUTATIONS / 2
    assert all(each.isprintable() and len(each) < 600 for each in told)
