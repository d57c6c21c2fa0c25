"""Networks that the tests make, and what they are in Python."""

import numpy as np
from onnx import TensorProto, helper, numpy_helper

FLOAT, DOUBLE = TensorProto.FLOAT, TensorProto.DOUBLE

GAIN = 1.8
KEPT = 0.3
"""What the recurrent network keeps of its state."""


def value(name, shape, kind=DOUBLE):
    return helper.make_tensor_value_info(name, kind, shape)


def weights(name, numbers, kind=np.float64):
    return numpy_helper.from_array(np.array(numbers, kind), name)


def model(nodes, inputs, outputs, tensors=(), opset=17, ir_version=8, domains=(), **more):
    """Return a model of nodes, given as operator, names of inputs, names of outputs."""
    made = [each if not isinstance(each, tuple) else node(*each) for each in nodes]
    graph = helper.make_graph(made, "policy", inputs, outputs, tensors)
    opsets = [helper.make_opsetid("", opset), *(helper.make_opsetid(each, 1) for each in domains)]
    return helper.make_model(graph, opset_imports=opsets, ir_version=ir_version, **more)


def node(operator, inputs, outputs, **attributes):
    return helper.make_node(operator, inputs.split(), outputs.split(), **attributes)


def proportional(kind=DOUBLE, shape=(1, 5)):
    """Return the template's policy as a network."""
    number = np.float64 if kind == DOUBLE else np.float32
    return model(
        [("MatMul", "seen gains", "action")],
        [value("seen", shape, kind)],
        [value("action", [*shape[:-1], 1], kind)],
        [weights("gains", [[GAIN], [0], [-GAIN], *([0],) * (shape[-1] - 3)], number)],
    )


def recurrent():
    """Return a network that smooths what it sees of the human's end by its state."""
    return model(
        [
            ("Gather", "seen first", "human"),
            ("Gather", "seen third", "hand"),
            ("Mul", "kept state", "old"),
            ("Mul", "new human", "fresh"),
            ("Add", "old fresh", "after"),
            ("Sub", "after hand", "short"),
            ("Mul", "gain short", "action"),
        ],
        [value("seen", [5]), value("state", [1])],
        [value("action", [1]), value("after", [1])],
        [
            weights("first", [0], np.int64),
            weights("third", [2], np.int64),
            weights("kept", [KEPT]),
            weights("new", [1 - KEPT]),
            weights("gain", [GAIN]),
        ],
    )


RECURRENT_IN_PYTHON = f"""
class Policy:
    def reset(self, seed):
        self.state = 0.0

    def act(self, observation):
        human, _, hand, *_ = observation
        self.state = {KEPT} * self.state + (1 - {KEPT}) * human
        return {GAIN} * (self.state - hand)
"""

MANIFEST = """
name = "{name}"
authors = ["Ada Lovelace"]
description = "A network."
licence = "MIT"
trained_on = "nothing"
"""


def write_network(folder, made, **keys):
    """Write a submission with a network."""
    folder.mkdir()
    (folder / "policy.onnx").write_bytes(made.SerializeToString())
    keys = {"model": '"policy.onnx"', **keys}
    lines = "".join(f"{key} = {text}\n" for key, text in keys.items())
    (folder / "policy.toml").write_text(MANIFEST.format(name=folder.name) + lines)
    return folder
