"""A network from ``colift check`` to a verified row: the score is that of the policy in Python."""

import json

import numpy as np
import pytest

pytest.importorskip("onnx", reason="needs onnx: uv sync --all-extras")
pytest.importorskip("onnxruntime", reason="needs onnxruntime: uv sync --all-extras")

from colift.agents.sandbox.host.policy import close_sandboxes
from colift.agents.submissions.new import write_template
from colift.agents.submissions.submission import read_submission
from colift.base.registry import SUITES, entries

from ..agents.onnx.networks import (
    DOUBLE,
    FLOAT,
    RECURRENT_IN_PYTHON,
    model,
    node,
    proportional,
    recurrent,
    value,
    weights,
    write_network,
)
from ..leaderboard import tiny

pytestmark = pytest.mark.slow


@pytest.fixture(autouse=True)
def small(monkeypatch, tmp_path):
    """A suite of two lifts, and a cache of the test's own."""
    monkeypatch.setitem(entries(SUITES), "tiny", tiny.ENTRY)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    yield
    close_sandboxes()


@pytest.fixture
def both(tmp_path):
    """Write the recurrent policy as a network, and in Python."""
    write_network(tmp_path / "net", recurrent())
    write_template(tmp_path / "code")
    (tmp_path / "code" / "policy.py").write_text(RECURRENT_IN_PYTHON)


def results(done):
    """Return the results that were printed, without names, digests and times."""
    content = json.loads(done.stdout)
    content.pop("policy")
    del content["summary"]["step_ms"]
    return content


@pytest.mark.usefixtures("both")
def test_it_has_the_score_of_the_same_policy_in_python(colift):
    net, code = (colift("run", name, "--suite", "tiny", "--json") for name in ("net", "code"))
    assert (net.returncode, code.returncode) == (0, 0), net.stderr + code.stderr
    assert results(net) == results(code)


@pytest.mark.usefixtures("both")
def test_it_is_checked_as_code_is(colift):
    done = colift("check", "net", "--json")
    content = json.loads(done.stdout)
    assert done.returncode == 0, done.stdout
    messages = {each["name"]: each["message"] for each in content["checks"]}
    assert messages["packages"] == "none: a network runs without code"
    assert "equal to the bit" in messages["determinism"]
    assert "RMSE" in messages["score"]


@pytest.mark.usefixtures("both")
def test_it_becomes_a_row_whose_bundle_can_be_verified(colift, tmp_path):
    done = colift("submit", "net", "--board", "board", "--suite", "tiny")
    assert done.returncode == 0, done.stdout + done.stderr
    next_step = done.stdout.splitlines()[-1]
    assert next_step.startswith("Next: colift verify ")
    verified = colift(*next_step.removeprefix("Next: colift ").split())
    assert verified.returncode == 0, verified.stdout + verified.stderr


def test_a_file_becomes_a_folder(colift, tmp_path):
    (tmp_path / "trained.onnx").write_bytes(recurrent().SerializeToString())
    done = colift("new", "mine", "--from", "trained.onnx")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines()[:3] == [
        "wrote mine/policy.toml",
        "wrote mine/policy.onnx",
        "network: observation 'seen' [5]; state 'state' [1], then 'after'; action 'action' in "
        "metres, clipped at 0.04 m per step",
    ]
    submission = read_submission(tmp_path / "mine")
    assert (submission.manifest.model, submission.manifest.name) == ("policy.onnx", "mine")
    (tmp_path / "trained.onnx").write_text("no network")
    done = colift("new", "other", "--from", "trained.onnx")
    assert (done.returncode, done.stderr) == (2, "error: trained.onnx is not an ONNX file\n")


def with_two(first, second):
    """Return a network of two operators, the second of which computes the action."""
    row = [weights("first", [0], np.int64)]
    return model([first, second], [value("seen", [5])], [value("action", [1])], row)


NEVER = {
    "a circle": (
        with_two(("Add", "seen back", "sum"), ("Gather", "sum first", "action")),
        "is not a sound graph",
    ),
    "an output twice": (
        with_two(("Gather", "seen first", "action"), ("Neg", "first", "action")),
        "is not a sound graph",
    ),
    "an input of nothing": (
        with_two(("Neg", "nowhere", "lost"), ("Add", "lost seen", "action")),
        "is not a sound graph",
    ),
    "10 billion numbers": (
        with_two(
            node("Constant", "", "wide", value=weights("", [2_000_000_000, 5], np.int64)),
            ("Expand", "seen wide", "action"),
        ),
        "computes 'action' of Expand with the shape [2000000000, 5]; at most 262144 numbers",
    ),
    "a division by zero": (
        model(
            [
                ("Sub", "one one", "zero"),
                ("Div", "one zero", "never"),
                node("Cast", "never", "lost", to=DOUBLE),
                ("Gather", "seen first", "picked"),
                ("Add", "picked lost", "action"),
            ],
            [value("seen", [5])],
            [value("action", [1])],
            [weights("one", [1], np.int64), weights("first", [0], np.int64)],
        ),
        "cannot be run by onnxruntime: ",
    ),
}


@pytest.mark.parametrize("name", NEVER)
def test_a_graph_that_can_never_run_makes_no_folder(colift, tmp_path, name):
    made, told = NEVER[name]
    (tmp_path / "trained.onnx").write_bytes(made.SerializeToString())
    done = colift("new", "mine", "--from", "trained.onnx")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("error: trained.onnx")
    assert told in done.stderr
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "mine").exists()


def test_a_network_of_the_training_view_is_taken_with_it(colift, tmp_path):
    (tmp_path / "trained.onnx").write_bytes(proportional(FLOAT, ("batch", 27)).SerializeToString())
    plain = colift("new", "plain", "--from", "trained.onnx")
    assert "a network of training_env needs view = 'training' in policy.toml" in plain.stdout
    done = colift("new", "mine", "--from", "trained.onnx,view=training")
    assert (done.returncode, done.stderr) == (0, "")
    assert read_submission(tmp_path / "mine").manifest.view == "training"
    checked = colift("check", "mine", COLUMNS="400")
    assert checked.returncode == 0, checked.stdout
    told = (
        "observation 'seen' [1, 27], by view = 'training' with 20 steps of the human's motion; "
        "action 'action' clipped to [-1, 1], for 0.03 m per step beside the human's last pace; "
        "batch of 1 ('batch')"
    )
    assert told in checked.stdout
    assert f"network: {told}" in done.stdout
    listed = colift("list", "mine").stdout
    assert "It is the network policy.onnx, in the view 'training'." in listed


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("trained.onnx,view=trainin", 'view must be "training" or "training-without-pace"'),
        ("trained.onnx,gain=2", "a network has no parameter 'gain'; it may have a view"),
        ("trained.onnx,view", "parameters must be name=value, separated by commas; got 'view'"),
        ("trained.onnx,view=training", "trained.onnx does not fit view = 'training'"),
        ("nowhere.onnx", "cannot read nowhere.onnx: No such file or directory"),
    ],
)
def test_a_network_that_cannot_be_taken_is_one_line(colift, tmp_path, text, told):
    (tmp_path / "trained.onnx").write_bytes(proportional().SerializeToString())
    done = colift("new", "mine", "--from", text)
    assert done.returncode == 2
    assert done.stderr.startswith(f"error: {told}")
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "mine").exists()


def test_a_file_that_must_not_be_run_is_named(colift, tmp_path):
    made = proportional()
    made.graph.node[0].op_type = "RandomNormalLike"
    write_network(tmp_path / "net", made)
    told = "policy.onnx uses the operator 'RandomNormalLike', which is not allowed"
    for words in (("check", "net"), ("run", "net"), ("submit", "net", "--board", "board")):
        done = colift(*words, COLUMNS="200")
        assert done.returncode != 0
        assert told in " ".join((done.stdout + done.stderr).split())
        assert "Traceback" not in done.stderr
