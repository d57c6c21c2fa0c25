"""The roles of inputs and outputs, by their names or else by their shapes; the batch; domains."""

import numpy as np
import pytest

pytest.importorskip("onnx", reason="needs onnx: uv sync --all-extras")
pytest.importorskip("onnxruntime", reason="needs onnxruntime: uv sync --all-extras")

from colift.agents.onnx.network import parse_network
from colift.agents.onnx.policy import OnnxPolicy
from colift.base.errors import InputError
from onnx import helper

from .networks import FLOAT, GAIN, model, node, value, weights

SEEN = np.random.default_rng(5).normal(0.0, 0.1, (20, 5))
WANTED = [float(np.float32(GAIN) * a + np.float32(-GAIN) * b) for a, _, b, *_ in np.float32(SEEN)]


def follower(inputs, outputs, new=(), **more):
    """Return a network whose action follows 'obs' or the first input, with states that stay."""
    names = [each.name for each in inputs]
    first = next((each for each in names if each == "obs"), names[0])
    others = [each for each in names if each != first]
    action, *after = new or [each.name for each in outputs]
    nodes = [("MatMul", f"{first} gains", action)]
    nodes += [("Identity", old, each) for old, each in zip(others, after, strict=True)]
    gains = weights("gains", [[GAIN], [0], [-GAIN], [0], [0]], np.float32)
    return model(nodes, inputs, outputs, [gains], **more)


def ports(**shapes):
    return [value(name, shape, FLOAT) for name, shape in shapes.items()]


def bound(made):
    """Return the names of observation, action and states before and after."""
    found = parse_network(made.SerializeToString(), "policy.onnx").signature
    states = {each.before.name: each.after.name for each in found.states}
    return found.observation.name, found.action.name, states


def actions(made, folder):
    (folder / "policy.onnx").write_bytes(made.SerializeToString())
    policy = OnnxPolicy(str(folder / "policy.onnx"))
    policy.reset(0)
    return [policy.act(seen) for seen in SEEN]


H, C = [1, 1, 8], [1, 1, 8]

RUN = {
    "one state, places as names": (
        ports(obs=[1, 5], h=H),
        ports(act=[1, 1], hn=H),
        ("obs", "act", {"h": "hn"}),
    ),
    "the states of an LSTM": (
        ports(obs=[1, 5], h=H, c=C),
        ports(act=[1, 1], hn=H, cn=C),
        ("obs", "act", {"h": "hn", "c": "cn"}),
    ),
    "an LSTM's new states in another order": (
        ports(obs=[1, 5], h0=H, c0=C),
        ports(act=[1, 1], cn=C, hn=H),
        ("obs", "act", {"h0": "hn", "c0": "cn"}),
    ),
    "numbered states": (
        ports(obs=[1, 5], state_0=H, state_1=C, state_2=H),
        ports(action=[1, 1], new_state_1=C, new_state_2=H, new_state_0=H),
        (
            "obs",
            "action",
            {"state_0": "new_state_0", "state_1": "new_state_1", "state_2": "new_state_2"},
        ),
    ),
    "a state before the observation": (
        ports(h=H, obs=[1, 5]),
        ports(hn=H, act=[1, 1]),
        ("obs", "act", {"h": "hn"}),
    ),
    "a state as wide as the observation, before it": (
        ports(h=[1, 5], obs=[1, 5]),
        ports(act=[1, 1], hn=[1, 5]),
        ("obs", "act", {"h": "hn"}),
    ),
    "a state as wide as the action": (
        ports(obs=[1, 5], memory=[1, 1]),
        ports(newMemory=[1, 1], mean=[1, 1]),
        ("obs", "mean", {"memory": "newMemory"}),
    ),
    "names that tell nothing, and shapes that tell": (
        ports(x=[1, 5], y=[1, 32], z=[2, 8]),
        ports(p=[1, 1], q=[2, 8], r=[1, 32]),
        ("x", "p", {"y": "r", "z": "q"}),
    ),
    "an observation named state": (
        ports(state=[1, 5], x=[1, 32]),
        ports(out=[1, 1], y=[1, 32]),
        ("state", "out", {"x": "y"}),
    ),
}


@pytest.mark.parametrize("name", RUN)
def test_roles_follow_from_names_or_shapes(tmp_path, name):
    inputs, outputs, roles = RUN[name]
    observation, action, states = roles
    made = follower(inputs, outputs)
    del made.graph.node[:]
    pairs = [("Identity", *pair) for pair in states.items()]
    for each in (("MatMul", f"{observation} gains", action), *pairs):
        made.graph.node.append(node(*each))
    assert bound(made) == roles
    assert actions(made, tmp_path) == pytest.approx(WANTED, abs=1e-7)


AMBIGUOUS = {
    "two inputs of one shape": (
        ports(x=[1, 5], y=[1, 5]),
        ports(a=[1, 1], b=[1, 5]),
        "has 'x' and 'y', of which neither names nor shapes tell the observation",
    ),
    "two observations by name": (
        ports(obs_a=[1, 5], obs_b=[1, 5]),
        ports(act=[1, 1], b=[1, 5]),
        "has 'obs_a' and 'obs_b', of which neither names nor shapes tell the observation",
    ),
    "two outputs of one shape": (
        ports(obs=[1, 5], x=[1, 1]),
        ports(a=[1, 1], b=[1, 1]),
        "has 'a' and 'b', of which neither names nor shapes tell the action",
    ),
    "two states of one shape": (
        ports(obs=[1, 5], x=H, y=H),
        ports(act=[1, 1], p=H, q=H),
        "has the states 'x', 'y' and the new states 'p', 'q', of which neither names nor shapes",
    ),
    "states of other shapes": (
        ports(obs=[1, 5], h=[1, 4], c=[1, 8]),
        ports(act=[1, 1], cn=[1, 4], hn=[1, 8]),
        "has the new state 'hn' with another shape or type than the state 'h'",
    ),
    "states that are large together": (
        ports(obs=[1, 5], h=[40_000], c=[40_000]),
        ports(act=[1, 1], hn=[40_000], cn=[40_000]),
        "has the state 'h' .*, 'c' .*; at most 65536 numbers are allowed",
    ),
}


@pytest.mark.parametrize("name", AMBIGUOUS)
def test_what_neither_tells_is_refused(name):
    inputs, outputs, told = AMBIGUOUS[name]
    made = follower(inputs, outputs)
    if name == "states of other shapes":
        made.graph.node[1].output[0], made.graph.node[2].output[0] = "cn", "hn"
    with pytest.raises(InputError, match=told):
        bound(made)


@pytest.mark.parametrize("batch", ["batch_size", "unk__6", -1, None])
def test_a_batch_without_a_size_is_one_lift(tmp_path, batch):
    other = "unk__7" if batch == "unk__6" else batch
    made = follower(ports(obs=[batch, 5]), ports(act=[other, 1]))
    made.graph.value_info.append(value("old", [batch, 1], FLOAT))
    fixed = follower(ports(obs=[1, 5]), ports(act=[1, 1]))
    assert actions(made, tmp_path) == actions(fixed, tmp_path)
    found = parse_network(made.SerializeToString(), "policy.onnx")
    assert found.batch == ("" if batch in (-1, None) else batch,)


def test_a_state_has_the_batch_of_the_observation():
    """Where PyTorch puts it in the states of an LSTM: second."""
    made = follower(ports(obs=["b", 5], h=[2, "b", 8]), ports(act=["b", 1], hn=[2, "b", 8]))
    [state] = parse_network(made.SerializeToString(), "policy.onnx").signature.states
    assert state.before.shape == state.after.shape == (2, 1, 8)
    other = follower(ports(obs=["b", 5], h=[2, "n", 8]), ports(act=["b", 1], hn=[2, "n", 8]))
    with pytest.raises(InputError, match=r"'h' with the shape \[2, n, 8\]: every size must be"):
        bound(other)


def test_sizes_that_a_graph_computes_from_its_batch_are_followed(tmp_path):
    """As PyTorch writes a reshape with the batch of its input."""
    nodes = [
        ("Shape", "obs", "shape"),
        ("Gather", "shape zero", "count"),
        node("Concat", "count one", "flat", axis=0),
        ("MatMul", "obs gains", "wide"),
        ("Reshape", "wide flat", "act"),
    ]
    tensors = [
        weights("gains", [[GAIN], [0], [-GAIN], [0], [0]], np.float32),
        weights("zero", [0], np.int64),
        weights("one", [1], np.int64),
    ]
    made = model(nodes, ports(obs=["batch", 5]), ports(act=["batch", 1]), tensors)
    assert actions(made, tmp_path) == pytest.approx(WANTED, abs=1e-7)


@pytest.mark.parametrize("domain", ["ai.onnx.ml", "com.microsoft", "pkg.onnxscript.torch_lib"])
def test_a_domain_without_operators_changes_nothing(tmp_path, domain):
    made = follower(ports(obs=[1, 5]), ports(act=[1, 1]), domains=[domain])
    plain = follower(ports(obs=[1, 5]), ports(act=[1, 1]))
    assert actions(made, tmp_path) == actions(plain, tmp_path)


@pytest.mark.parametrize("declared", [["", "ai.onnx"], ["ai.onnx", ""], ["ai.onnx"], [""]])
@pytest.mark.parametrize("used", ["", "ai.onnx"])
def test_both_names_of_onnx_s_own_domain_are_one(tmp_path, declared, used):
    made = follower(ports(obs=[1, 5]), ports(act=[1, 1]))
    plain = actions(made, tmp_path)
    made.graph.node[0].domain = used
    del made.opset_import[:]
    made.opset_import.extend(helper.make_opsetid(each, 17) for each in declared)
    assert actions(made, tmp_path) == plain


def test_a_network_that_fails_at_its_first_step_is_refused_before(tmp_path):
    made = model(
        [
            node("Cast", "obs", "places", to=7),
            ("ReduceMax", "places", "most"),
            ("Add", "most far", "place"),
            ("Gather", "row place", "one"),
            ("Reshape", "one flat", "act"),
        ],
        ports(obs=[1, 5]),
        ports(act=[1]),
        [
            weights("row", [0.0, 0.0], np.float32),
            weights("far", [9], np.int64),
            weights("flat", [1], np.int64),
        ],
    )
    with pytest.raises(InputError, match=r"policy.onnx cannot be run by onnxruntime: .*Gather"):
        actions(made, tmp_path)
