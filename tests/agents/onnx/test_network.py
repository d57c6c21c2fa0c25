"""What of a network is refused before it runs, and that the message names it."""

import re

import numpy as np
import pytest

pytest.importorskip("onnx", reason="needs onnx: uv sync --all-extras")

from colift.agents.onnx.allowed import LARGEST
from colift.agents.onnx.network import parse_network
from colift.base.errors import InputError
from onnx import TensorProto, helper

from .networks import DOUBLE, FLOAT, model, node, proportional, recurrent, value, weights

SEEN, ACTION = [value("seen", [5])], [value("action", [1])]
FIRST = weights("first", [0], np.int64)
TWICE = {
    "inputs": [*SEEN, value("state", [1])],
    "outputs": [*ACTION, value("after", [1])],
}
PICK = ("Gather", "seen first", "action")


def checked(made):
    """Return what is refused of a model, or an empty text."""
    data = made if isinstance(made, bytes) else made.SerializeToString()
    try:
        parse_network(data, "policy.onnx")
    except InputError as error:
        return str(error)
    return ""


def picked(**changes):
    """Return a good network with changes: its action is the first number that it sees."""
    parts = {"nodes": [PICK], "inputs": SEEN, "outputs": ACTION, "tensors": [FIRST]}
    return model(**{**parts, **changes})


def external():
    made = picked()
    tensor = made.graph.initializer[0]
    helper_entry = tensor.external_data.add()
    helper_entry.key, helper_entry.value = "location", "../secret"
    tensor.data_location = TensorProto.EXTERNAL
    tensor.ClearField("raw_data")
    return made


def branching():
    inner = helper.make_graph(
        [node("Identity", "seen", "inner")], "inner", [], [value("inner", [5])]
    )
    return picked(
        nodes=[node("If", "yes", "action", then_branch=inner, else_branch=inner)],
        tensors=[weights("yes", True, np.bool_)],
    )


def with_function():
    body = helper.make_function(
        "own", "Own", ["x"], ["y"], [node("Identity", "x", "y")], [helper.make_opsetid("", 17)]
    )
    return picked(functions=[body])


def sparse():
    made = picked()
    made.graph.sparse_initializer.add()
    return made


def without_opset():
    made = picked(domains=["ai.onnx.ml"])
    del made.opset_import[0]
    return made


def of_wrong_data():
    made = picked()
    made.graph.initializer[0].dims[0] = 7
    return made


def of_another_shape():
    made = picked()
    made.graph.initializer[0].dims[:] = [-1, 2**40]
    return made


def filled(shape):
    """Return a network that makes a tensor of a shape from nothing."""
    return picked(
        nodes=[
            PICK[:2] + ("picked",),
            node("ConstantOfShape", "shape", "huge", value=weights("", [1.0])),
            ("ReduceSum", "huge", "sum"),
            ("Add", "picked sum", "wide"),
            ("Reshape", "wide one", "action"),
        ],
        tensors=[FIRST, weights("shape", shape, np.int64), weights("one", [1], np.int64)],
    )


def expanded(shape):
    return picked(
        nodes=[
            ("Expand", "seen shape", "huge"),
            ("ReduceMax", "huge", "most"),
            ("Reshape", "most one", "action"),
        ],
        tensors=[weights("shape", shape, np.int64), weights("one", [1], np.int64)],
    )


def sized(count):
    """Return a network that computes many whole numbers, from which sizes might follow."""
    return picked(
        nodes=[
            ("Expand", "first count", "huge"),
            ("Add", "huge huge", "sizes"),
            ("ReduceMax", "sizes", "most"),
            ("Gather", "seen most", "action"),
        ],
        tensors=[FIRST, weights("count", [count], np.int64)],
    )


def of_unknown_size():
    """Return a network the size of whose tensor depends on what it sees, and denies it."""
    made = picked(
        nodes=[
            node("Cast", "seen", "shape", to=TensorProto.INT64),
            node("ConstantOfShape", "shape", "huge"),
            node("ReduceSum", "huge", "sum", keepdims=0),
            node("Reshape", "sum one", "action"),
        ],
        tensors=[weights("one", [1], np.int64)],
    )
    made.graph.output[0].type.tensor_type.elem_type = FLOAT
    made.graph.value_info.append(value("huge", [1, 1, 1, 1, 1], FLOAT))
    return made


def of_long_memory():
    """Return a network whose recurrent operator has far larger inner tensors than its output."""
    return picked(
        nodes=[
            node("Expand", "seen shape", "long"),
            node("Reshape", "long steps", "sequence"),
            helper.make_node("GRU", ["sequence", "W", "R"], ["", "last"], hidden_size=200),
            node("Slice", "last from to", "part"),
            node("Reshape", "part one", "action"),
        ],
        inputs=[value("seen", [5], FLOAT)],
        outputs=[value("action", [1], FLOAT)],
        tensors=[
            weights("shape", [20_000, 5], np.int64),
            weights("steps", [100_000, 1, 1], np.int64),
            weights("W", np.ones((1, 600, 1)), np.float32),
            weights("R", np.ones((1, 600, 200)), np.float32),
            weights("from", [0, 0, 0], np.int64),
            weights("to", [1, 1, 1], np.int64),
            weights("one", [1], np.int64),
        ],
    )


REFUSED = {
    "text": (b"import os\n", "is not an ONNX file"),
    "nothing": (b"", "is not an ONNX file: it has no graph"),
    "half": (proportional().SerializeToString()[:-30], "is not an ONNX file"),
    "large": (bytes(LARGEST + 1), "has more than 16 MiB"),
    "of the future": (picked(ir_version=99), "has the IR version 99; 7 to 10 can be run"),
    "old": (picked(opset=9), "has the opset 9; 13 to 21 can be run"),
    "new": (picked(opset=99), "has the opset 99; 13 to 21 can be run"),
    "no opset of its own operators": (
        without_opset(),
        "has no opset of ONNX's own operators; 13 to 21 can be run: export it again",
    ),
    "two opsets": (
        picked(domains=["ai.onnx"]),
        "has the opsets 1 and 17 of ONNX's own operators; it must have one",
    ),
    "an operator of another domain": (
        picked(nodes=[node("Run", "seen", "action", domain="com.evil")]),
        "operator 'Run' of the domain 'com.evil'",
    ),
    "chance": (
        picked(nodes=[node("RandomNormal", "", "action", shape=[1])]),
        "operator 'RandomNormal', which is not allowed",
    ),
    "a loop": (branching(), "operator 'If', which is not allowed"),
    "functions": (with_function(), "functions"),
    "sparse weights": (sparse(), "sparse weights"),
    "external data": (external(), "the weights 'first' in another file"),
    "NaN": (
        picked(
            nodes=[PICK[:2] + ("picked",), ("Mul", "picked gain", "action")],
            tensors=[FIRST, weights("gain", [np.nan])],
        ),
        "NaN in the weights 'gain'",
    ),
    "NaN in a constant": (
        picked(
            nodes=[
                node("Constant", "", "gain", value=weights("", [np.nan])),
                ("Gather", "seen first", "picked"),
                ("Mul", "picked gain", "action"),
            ]
        ),
        "NaN in the attribute 'value' of Constant",
    ),
    "half precision": (
        picked(tensors=[FIRST, weights("half", [1.0], np.float16)]),
        "the weights 'half', whose type is not float, double, int32, int64 or bool",
    ),
    "wrong data": (of_wrong_data(), "the weights 'first', whose data are not of its shape"),
    "a shape that is none": (of_another_shape(), "the weights 'first' with the impossible shape"),
    "no input": (picked(nodes=[node("Identity", "first", "action")], inputs=[]), "inputs none"),
    "three inputs and one output": (
        picked(inputs=[*SEEN, value("state", [1]), value("goal", [1])]),
        r"outputs 'action'; with its inputs \('seen', 'state', 'goal'\) it must have the action "
        "and the new state of each",
    ),
    "two observations and one output": (
        picked(inputs=[*SEEN, value("more", [5])]),
        r"outputs 'action'; with its inputs \('seen', 'more'\) it must have the action and the new",
    ),
    "two outputs": (
        picked(nodes=[PICK, ("Neg", "action", "more")], outputs=[*ACTION, value("more", [1])]),
        r"outputs 'action', 'more'; with its inputs \('seen'\) it must have the action alone",
    ),
    "a size that is open": (
        picked(inputs=[value("seen", ["batch", "n"])]),
        r"'seen' with the shape \[1, n\]: every size must be a number, but the first of several, "
        "which is .* onnx.tools.update_model_dims.update_inputs_outputs_dims sets them",
    ),
    "an only size that is open": (
        picked(inputs=[value("seen", ["n"])]),
        r"'seen' with the shape \[n\]: every size must be a number",
    ),
    "a size of zero": (
        picked(inputs=[value("seen", [0, 5])]),
        r"'seen' with the shape \[.*, 5\]: every size must be a number",
    ),
    "a short observation": (
        picked(inputs=[value("seen", [4])]),
        r"observation 'seen' with the shape \[4\]; it must be \[n\] or \[1, n\], with n = 5 for",
    ),
    "a long observation": (
        picked(inputs=[value("seen", [1, 65])]),
        r"observation 'seen' with the shape \[1, 65\]; it must be .*, and 5 to 64 for other tasks",
    ),
    "a batch of observations": (
        picked(inputs=[value("seen", [2, 5])]),
        r"observation 'seen' with the shape \[2, 5\]; it must be",
    ),
    "an observation without a shape": (
        picked(nodes=[("Neg", "seen", "action")], inputs=[value("seen", [])]),
        r"observation 'seen' with the shape \[\]; it must be",
    ),
    "whole numbers": (
        picked(inputs=[value("seen", [5], TensorProto.INT64)]),
        "'seen', which is not a tensor of float or double",
    ),
    "a large state": (
        picked(
            nodes=[PICK, ("Neg", "state", "after")],
            inputs=[*SEEN, value("state", [10**9])],
            outputs=[*ACTION, value("after", [10**9])],
        ),
        r"input 'state' with the shape \[1000000000\]; at most 65536 numbers",
    ),
    "another new state": (
        picked(
            nodes=[PICK, ("Identity", "seen", "after")],
            inputs=[*SEEN, value("state", [1])],
            outputs=[*ACTION, value("after", [5])],
        ),
        "new state 'after' with another shape or type than the state 'state'",
    ),
    "two actions": (
        picked(nodes=[("Neg", "seen", "action")], outputs=[value("action", [5])]),
        r"action 'action' with the shape \[5\]; it must be \[1\]",
    ),
    "no such tensor": (picked(nodes=[("Neg", "nowhere", "action")]), "is not a sound graph"),
    "a circle": (
        picked(nodes=[("Add", "seen action", "sum"), ("Gather", "sum first", "action")]),
        "is not a sound graph",
    ),
    "two operators of one output": (picked(nodes=[PICK, PICK]), "is not a sound graph"),
    "an output of nothing": (
        picked(nodes=[PICK, ("Neg", "state", "other")], **TWICE),
        "is not a sound graph|'after', which no operator computes",
    ),
    "an output twice": (
        picked(
            nodes=[PICK],
            inputs=[*SEEN, value("state", [1])],
            outputs=[*ACTION, *ACTION],
        ),
        "is not a sound graph|has a name twice among 'action', 'action'",
    ),
    "10 GB from nothing": (filled([50_000, 50_000]), "computes 'huge' of ConstantOfShape"),
    "10 GB by Expand": (expanded([500_000, 500, 5]), "computes 'huge' of Expand"),
    "10 billion numbers that are sizes": (sized(10**10), "computes 'huge' of Expand with"),
    "a size that depends on the input": (of_unknown_size(), "'huge' of ConstantOfShape, whose"),
    "a long memory": (of_long_memory(), "numbers in a GRU; at most"),
    "many operators": (
        picked(nodes=[PICK, *[("Neg", "seen", f"n{i}") for i in range(2000)]]),
        "has 2001 operators; at most 2000",
    ),
    "much together": (
        picked(
            nodes=[PICK, *[("Expand", "seen shape", f"n{i}") for i in range(20)]],
            tensors=[FIRST, weights("shape", [50_000, 5], np.int64)],
        ),
        "computes 5000001 numbers in a step",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_hostile_file_is_refused_by_name(name):
    made, told = REFUSED[name]
    found = checked(made)
    assert found
    assert re.search(told, found), found


GOOD = {
    "one operator": picked(),
    "proportional": proportional(),
    "in single precision": proportional(FLOAT),
    "without a row": proportional(shape=(5,)),
    "of a task with touch": proportional(shape=(1, 11)),
    "recurrent": recurrent(),
    "the newest opset": picked(opset=21, ir_version=10),
}


@pytest.mark.parametrize("name", GOOD)
def test_a_good_network_is_not_refused(name):
    assert checked(GOOD[name]) == ""


def test_the_signature_is_read():
    network = parse_network(recurrent().SerializeToString(), "policy.onnx").signature
    [state] = network.states
    assert (network.observation.name, network.observation.shape) == ("seen", (5,))
    assert state.before.form == state.after.form == ((1,), DOUBLE)
    assert (network.action.name, state.after.name) == ("action", "after")
