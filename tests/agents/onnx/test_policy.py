"""A network as a policy: the actions of the same policy in Python, in a sandbox and without one."""

import os
import subprocess
import sys

import numpy as np
import pytest

pytest.importorskip("onnx", reason="needs onnx: uv sync --all-extras")
pytest.importorskip("onnxruntime", reason="needs onnxruntime: uv sync --all-extras")

from colift.agents.onnx.allowed import LARGEST
from colift.agents.onnx.policy import OnnxPolicy
from colift.agents.sandbox.host.policy import close_sandboxes
from colift.agents.submissions.submission import (
    open_submission,
    read_submission,
)
from colift.base.errors import InputError

from ...conftest import peak_memory
from .networks import (
    FLOAT,
    GAIN,
    RECURRENT_IN_PYTHON,
    model,
    node,
    proportional,
    recurrent,
    value,
    weights,
    write_network,
)

OBSERVATIONS = np.random.default_rng(3).normal(0.0, 0.1, (40, 5))


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    yield
    close_sandboxes()


def actions(agent):
    agent.reset(0)
    return [float(np.squeeze(agent.act(observation))) for observation in OBSERVATIONS]


def in_python():
    scope = {}
    exec(RECURRENT_IN_PYTHON, scope)
    return scope["Policy"]()


def played(policy):
    with policy.agent() as agent:
        return actions(agent)


@pytest.mark.parametrize(("kind", "shape"), [(FLOAT, (1, 5)), (FLOAT, (5,)), (11, (1, 5))])
def test_the_action_is_the_networks(tmp_path, kind, shape):
    folder = write_network(tmp_path / "net", proportional(kind, shape))
    wanted = [GAIN * (seen[0] - seen[2]) for seen in OBSERVATIONS]
    assert actions(OnnxPolicy(str(folder / "policy.onnx"))) == pytest.approx(wanted, abs=1e-6)


@pytest.mark.parametrize("size", [5, 7, 11])
def test_it_sees_the_first_numbers_of_a_longer_observation(tmp_path, size):
    folder = write_network(tmp_path / "net", proportional(shape=(1, size)))
    policy = OnnxPolicy(str(folder / "policy.onnx"))
    longer = np.random.default_rng(4).normal(0.0, 0.1, (20, 11))
    policy.reset(0)
    wanted = [GAIN * (seen[0] - seen[2]) for seen in longer]
    assert [policy.act(seen) for seen in longer] == pytest.approx(wanted, abs=1e-12)


def test_a_network_of_another_task_is_told_from_this_tasks_observation(tmp_path):
    folder = write_network(tmp_path / "net", proportional(shape=(1, 7)))
    policy = OnnxPolicy(str(folder / "policy.onnx"))
    policy.reset(0)
    with pytest.raises(
        InputError, match=r"takes an observation of 7 numbers, and this task's has 5"
    ):
        policy.act(OBSERVATIONS[0])


def test_the_state_goes_on_and_begins_as_zero(tmp_path):
    folder = write_network(tmp_path / "net", recurrent())
    policy, wanted = OnnxPolicy(str(folder / "policy.onnx")), actions(in_python())
    assert actions(policy) == wanted
    assert actions(policy) == wanted


def test_a_gru_is_run(tmp_path):
    """As a trainer exports it: single precision, a hidden state of its own, a layer behind."""
    rng = np.random.default_rng(1)
    w, r, out = rng.normal(0, 0.5, (1, 12, 5)), rng.normal(0, 0.5, (1, 12, 4)), rng.normal(size=4)
    made = model(
        [
            ("Unsqueeze", "seen zero", "sequence"),
            node("GRU", "sequence w r  ", "all after", hidden_size=4),
            ("Reshape", "after flat", "hidden"),
            ("MatMul", "hidden out", "action"),
        ],
        [value("seen", [1, 5], FLOAT), value("state", [1, 1, 4], FLOAT)],
        [value("action", [1, 1], FLOAT), value("after", [1, 1, 4], FLOAT)],
        [
            weights("zero", [0], np.int64),
            weights("flat", [1, 4], np.int64),
            weights("w", w, np.float32),
            weights("r", r, np.float32),
            weights("out", out[:, None], np.float32),
        ],
    )
    made.graph.node[1].input.extend(["", "", "state"])
    folder = write_network(tmp_path / "net", made)

    def sigmoid(x):
        return 1 / (1 + np.exp(-x))

    state, wanted = np.zeros(4), []
    for seen in OBSERVATIONS:
        (iz, ir, ih), (hz, hr, _) = np.split(w[0] @ seen, 3), np.split(r[0] @ state, 3)
        update, restart = sigmoid(iz + hz), sigmoid(ir + hr)
        fresh = np.tanh(ih + r[0][8:] @ (restart * state))
        state = (1 - update) * fresh + update * state
        wanted.append(out @ state)
    assert actions(OnnxPolicy(str(folder / "policy.onnx"))) == pytest.approx(wanted, abs=1e-5)


def test_it_acts_in_every_sandbox_as_without_one(tmp_path, each_level):
    submission = open_submission(write_network(tmp_path / "net", recurrent()))
    wanted = actions(in_python())
    assert played(submission.sandboxed(each_level)) == wanted
    assert played(submission.trusted()) == wanted


def test_a_network_that_is_too_large_is_refused_where_it_would_run(tmp_path):
    made = proportional()
    made.graph.node.append(node("Expand", "seen wide", "huge"))
    made.graph.initializer.append(weights("wide", [100_000, 5], np.int64))
    submission = open_submission(write_network(tmp_path / "net", made))
    for policy in (submission.sandboxed(), submission.trusted()):
        with pytest.raises(InputError, match="computes 'huge' of Expand with the shape"):
            policy.check()


def test_no_code_of_the_folder_runs(tmp_path):
    folder = write_network(tmp_path / "net", recurrent())
    for name in ("policy.py", "onnxruntime.py", "onnx.py", "sitecustomize.py"):
        (folder / name).write_text("raise SystemExit('it ran')\n")
    submission = open_submission(folder)
    wanted = actions(in_python())
    assert played(submission.sandboxed()) == wanted
    assert played(submission.trusted()) == wanted


def test_the_digest_covers_the_network(tmp_path):
    folder = write_network(tmp_path / "net", proportional())
    before = read_submission(folder).sandboxed().digest()
    (folder / "policy.onnx").write_bytes(recurrent().SerializeToString())
    assert read_submission(folder).sandboxed().digest() != before


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ({"model": '"other.onnx"'}, "model 'other.onnx' is not in the folder; it has policy.onnx"),
        ({"model": '"../policy.onnx"'}, "model must be the path of an ONNX file in this folder"),
        ({"model": '"policy.py"'}, "model must be the path of an ONNX file in this folder"),
        ({"model": "3"}, "model must be the path of an ONNX file in this folder"),
        ({"entry_point": '"policy:Policy"'}, "model and entry_point exclude each other"),
        ({"packages": '["numpy"]'}, "model and packages exclude each other"),
    ],
)
def test_a_manifest_that_does_not_fit_is_refused(tmp_path, keys, told):
    folder = write_network(tmp_path / "net", proportional(), **keys)
    with pytest.raises(InputError, match=told):
        read_submission(folder)


def test_the_file_is_named_where_it_is_refused(tmp_path):
    folder = write_network(tmp_path / "net", proportional())
    (folder / "policy.onnx").write_bytes(b"no network")
    with pytest.raises(InputError, match=r"policy net: policy\.onnx is not an ONNX file"):
        open_submission(folder).sandboxed().check()
    (folder / "policy.onnx").write_bytes(bytes(LARGEST + 1))
    with pytest.raises(InputError, match=r"net/policy\.onnx has 16777217 bytes"):
        open_submission(folder)


def test_the_library_reports_nothing_to_its_maker(tmp_path):
    """Where it does, it keeps what it sends in the user's cache."""
    folder = write_network(tmp_path / "net", proportional())
    home = tmp_path / "home"
    home.mkdir()
    load = "import colift.agents.onnx.policy as p, sys; p.OnnxPolicy(sys.argv[1]).reset(0)"
    done = subprocess.run(
        [sys.executable, "-c", load, folder / "policy.onnx"],
        env={"HOME": str(home), "PATH": os.environ["PATH"]},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert list(home.rglob("*")) == []


SEALED = """
import os, sys, threading
import numpy as np
from colift.agents.onnx.policy import OnnxPolicy

policy = OnnxPolicy(sys.argv[1])
policy.reset(0)
loaded, files = set(sys.modules), set(os.listdir("/proc/self/fd"))
events = []
sys.addaudithook(lambda event, _: events.append(event))
actions = [policy.act(np.full(5, 0.01 * step)) for step in range(20)]
unexpected = [each for each in events if each.split(".")[0] in ("open", "import", "os", "_thread")]
assert unexpected == [], unexpected
assert (set(sys.modules), set(os.listdir("/proc/self/fd"))) == (loaded, files)
print(len(os.listdir("/proc/self/task")), len(set(actions)))
"""


def test_a_step_opens_no_file_imports_nothing_and_starts_no_thread(tmp_path):
    folder = write_network(tmp_path / "net", recurrent())
    done = subprocess.run(
        [sys.executable, "-c", SEALED, folder / "policy.onnx"],
        env={"PATH": os.environ["PATH"], "OPENBLAS_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.stdout, done.stderr) == ("1 20\n", "")


@pytest.mark.parametrize("library", ["onnx", "onnxruntime"])
def test_without_the_extra_it_is_named(tmp_path, monkeypatch, library):
    folder = write_network(tmp_path / "net", proportional())
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(InputError, match=rf"needs {library}: .*(onnx|--all-extras)"):
        open_submission(folder)


@pytest.mark.slow
def test_a_small_file_that_takes_much_memory_harms_nobody(tmp_path):
    """Empty entries take a hundred times as much memory as they have bytes."""
    folder = write_network(tmp_path / "net", proportional())
    entries = b"\x2a\x00" * (2**23 - 50)
    length = [len(entries) >> 7 * k & 127 | 128 * (k < 3) for k in range(4)]
    (folder / "policy.onnx").write_bytes(b"\x08\x08\x3a" + bytes(length) + entries)
    before = peak_memory()
    with pytest.raises(InputError, match=r"is not an ONNX file|memory"):
        open_submission(folder).sandboxed().check()
    assert peak_memory() - before < 2**28


def test_a_network_has_no_parameters(tmp_path):
    submission = read_submission(write_network(tmp_path / "net", proportional()))
    with pytest.raises(InputError, match="net is a network, which has no parameters; got 'gain=2'"):
        submission.sandboxed(parameters="gain=2")
