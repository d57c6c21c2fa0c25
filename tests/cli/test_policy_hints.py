"""What is said of a file that is not yet a policy's name, and of imports that fail."""

import json

import numpy as np
import pytest
from colift.agents.submissions.new import write_template

KALMAN = """
class Filter:
    def step(self, z): return z
class Kalman:
    def reset(self, seed): pass
    def act(self, observation): return [0.0]
class Report: pass
"""

ACTS = """
class P:
    def reset(self, seed): pass
    def act(self, observation): return {}
"""

QUICK = ("--suite", "quick-v1", "--jobs", "1")


@pytest.fixture
def lab(tmp_path):
    (tmp_path / "kalman.py").write_text(KALMAN)
    (tmp_path / "net.onnx").write_bytes(b"\x08\x08")
    (tmp_path / "notes.txt").touch()
    write_template(tmp_path / "mine")
    return tmp_path


@pytest.mark.parametrize("command", ["run", "list", "render"])
@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("kalman", "unknown policy 'kalman'; for the file kalman.py give kalman.py:Kalman\n"),
        ("kalman.py", "kalman.py names no class; give kalman.py:Kalman\n"),
        ("./kalman.py,gain=1", "kalman.py names no class; give kalman.py:Kalman\n"),
        (
            "net.onnx",
            "net.onnx is a network, not yet a submission ('colift new DIR --from net.onnx'",
        ),
        ("./net.onnx", "('colift new DIR --from ./net.onnx' makes one from it)"),
        ("mine/policy.toml", "mine/policy.toml is a file of a submission; give its folder, mine\n"),
        ("mine/policy.py", "give mine/policy.py:Policy\n"),
        (
            "notes.txt",
            "notes.txt is no policy: give a name, file.py:Class or a submission's folder",
        ),
        (
            "blendd",
            "unknown policy 'blendd'; did you mean blend ",
        ),
        ("qqq", "unknown policy 'qqq' ('colift list' lists all names)\n"),
    ],
)
def test_a_file_gets_the_form_that_works(colift, lab, command, text, told):
    out = ("--out", "x.png") if command == "render" else ()
    done = colift(command, text, *out)
    assert (done.returncode, done.stdout) == (2, "")
    assert told in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize("command", ["check", "submit"])
def test_a_network_is_no_folder_yet(colift, lab, command):
    board = ("--board", "b") if command == "submit" else ()
    done = colift(command, "net.onnx", *board)
    assert "'colift new DIR --from net.onnx' makes one from it" in " ".join(
        (done.stdout + done.stderr).split()
    )


@pytest.mark.parametrize("isolation", ["auto", "none"])
@pytest.mark.parametrize(
    ("module", "told"),
    [
        ("no_such_torch", "boards provide filterpy, numpy, scikit-learn, scipy; a network of"),
        ("no_such_torch.nn", "'colift new DIR --from NET.onnx'"),
        ("helper", "a policy of one file does not see helper.py beside it: 'colift new DIR --from"),
    ],
)
def test_an_import_that_fails_has_its_remedy(colift, tmp_path, isolation, module, told):
    if module == "helper":
        (tmp_path / "helper.py").touch()
    (tmp_path / "mine.py").write_text(f"import {module}\n{ACTS.format('[0.0]')}")
    done = colift("run", "mine.py:P", *QUICK, "--isolation", isolation)
    assert done.returncode == 2
    assert "No module named" in done.stderr
    assert told in done.stderr
    answer = colift("run", "mine.py:P", *QUICK, "--json", "--isolation", isolation)
    assert told in json.loads(answer.stdout)["error"]


def test_a_package_that_boards_lack_is_noted_before_a_run(colift, tmp_path):
    (tmp_path / "mine.py").write_text(f"import msgpack, numpy, json\n{ACTS.format('[0.0]')}")
    done = colift("run", "mine.py:P", *QUICK)
    assert done.returncode == 0
    assert (
        "note: mine.py imports msgpack, which boards need not have; a submission may" in done.stderr
    )
    assert colift("run", "hold", *QUICK).stderr == ""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("act", "told"),
    [
        ("800 * (observation[:1] - observation[3])", ("change of the height, in metres", "Worse")),
        ("observation[:1] * 1.0", ("An action must be a change of the height, in metres", "Worse")),
        ("-(observation[:1] - observation[3]) / 20", ("Worse than hold (never moves, ",)),
        ("1.5 * (observation[:1] - observation[3])", ()),
    ],
)
def test_a_run_says_what_a_check_says(colift, tmp_path, act, told):
    (tmp_path / "mine.py").write_text(ACTS.format(act))
    done = colift("run", "mine.py:P", *QUICK)
    assert done.returncode == 0
    for each in told:
        assert each in " ".join(done.stdout.split())
    assert told or not {"Worse", "clipped:"} & {*done.stdout.split()}
    assert np.isfinite(json.loads(colift("run", "mine.py:P", *QUICK, "--json").stdout)["scoring"])
