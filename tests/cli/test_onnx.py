"""A network from ``colift check`` to a verified row: the score is that of the policy in Python."""

import json

import pytest

pytest.importorskip("onnx", reason="needs onnx: uv sync --all-extras")
pytest.importorskip("onnxruntime", reason="needs onnxruntime: uv sync --all-extras")

from colift.agents.registry import SUITES, entries
from colift.agents.sandbox.host.policy import close_sandboxes
from colift.agents.submissions.new import write_template
from colift.agents.submissions.submission import read_submission

from ..agents.onnx.networks import (
    RECURRENT_IN_PYTHON,
    proportional,
    recurrent,
    write_network,
)
from ..leaderboard import tiny


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
    assert done.stdout.splitlines()[:2] == ["wrote mine/policy.toml", "wrote mine/policy.onnx"]
    submission = read_submission(tmp_path / "mine")
    assert (submission.manifest.model, submission.manifest.name) == ("policy.onnx", "mine")
    (tmp_path / "trained.onnx").write_text("no network")
    done = colift("new", "other", "--from", "trained.onnx")
    assert (done.returncode, done.stderr) == (2, "error: trained.onnx is not an ONNX file\n")


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
