"""``colift new``, and the folders and files that it makes, as a user meets them."""

import json

import pytest
from colift.agents.submissions.submission import read_submission

pytestmark = pytest.mark.slow


def test_a_template_is_written_once_and_the_next_step_told(colift, tmp_path):
    done = colift("new", "mine", cwd=tmp_path)
    assert done.returncode == 0
    assert done.stdout.splitlines() == [
        "wrote mine/policy.toml",
        "wrote mine/policy.py",
        "Next: edit them, then colift check mine",
    ]
    assert "def act" in (tmp_path / "mine" / "policy.py").read_text()
    again = colift("new", "mine", cwd=tmp_path)
    assert again.returncode == 2
    assert again.stderr == "error: mine is not empty; name a new folder\n"


PD = '''"""Tried in an evening."""
import numpy as np

class Helper:
    pass

class PD:
    "Goes where the human is going."
    def __init__(self, gain: float = 1.5, lead: float = 0.1):
        self.gain, self.lead = gain, lead
    def reset(self, seed):
        self.last = 0.0
    def act(self, observation):
        speed = (observation[0] - self.last) / 0.1
        self.last = observation[0]
        return self.gain * (observation[0] + self.lead * speed - observation[2])
'''


@pytest.fixture
def pd(tmp_path):
    (tmp_path / "pd.py").write_text(PD)
    return tmp_path / "pd.py"


def summary(done):
    assert done.returncode == 0, done.stderr
    content = json.loads(done.stdout)["summary"]
    del content["step_ms"], content["real_time"]
    return content


QUICK = ("--suite", "quick-v1", "--seeds", "0:1", "--jobs", 1, "--json")


def test_a_file_with_parameters_becomes_a_folder_that_scores_the_same(colift, pd, tmp_path):
    done = colift("new", "mine", "--from", "pd.py:PD, lead=0.25 ,gain=1.2")
    assert (done.returncode, done.stderr) == (0, "")
    manifest = read_submission(tmp_path / "mine").manifest
    assert manifest.entry_point == "policy:PD"
    assert manifest.parameters == "gain=1.2,lead=0.25"
    assert manifest.packages == ("numpy",)
    assert manifest.description == "Goes where the human is going."
    wanted = summary(colift("run", "pd.py:PD,gain=1.2,lead=0.25", *QUICK))
    for isolation in ("auto", "none"):
        assert summary(colift("run", "mine", "--isolation", isolation, *QUICK)) == wanted
    others = [
        summary(colift("run", place, *QUICK))
        for place in ("pd.py:PD,gain=1.2,lead=0", "mine,lead=0", "./mine/,lead=0,gain=1.2")
    ]
    assert others[0] == others[1] == others[2] != wanted


SETTINGS = """from dataclasses import dataclass

@dataclass(frozen=True)
class Settings:
    gain: float = 1.0

class Policy:
    def __init__(self, parameters: Settings = Settings(), *, filter: Settings = Settings()):
        self.gain = parameters.gain
    def reset(self, seed): pass
    def act(self, observation): return self.gain * observation[0]

class Derived(Policy):
    pass
"""


@pytest.mark.parametrize("name", ["Policy", "Derived"])
@pytest.mark.parametrize("parameter", ["gain=0.5", "filter.gain=0.5"])
def test_parameters_of_dataclasses_and_base_classes_are_taken(colift, tmp_path, name, parameter):
    (tmp_path / "own.py").write_text(SETTINGS)
    assert colift("new", "mine", "--from", f"own.py:{name},{parameter}").returncode == 0
    done = colift("run", "mine", "--isolation", "none", *QUICK)
    assert (done.returncode, json.loads(done.stdout)["summary"]["failed"]) == (0, 0)
    manifest = read_submission(tmp_path / "mine").manifest
    assert manifest.description == "A policy."  # Not that of the template.
    checked = " ".join(colift("check", "mine").stdout.split())
    assert "a description (it is that of 'colift new')" in checked


def test_a_folders_parameters_change_its_name_and_digest(colift, pd):
    colift("new", "mine", "--from", "pd.py:PD")
    policies = [
        json.loads(colift("run", place, *QUICK).stdout)["policy"]
        for place in ("mine", "mine,gain=1", "mine,gain=1.5")
    ]
    assert [policy["name"] for policy in policies] == ["mine", "mine,gain=1", "mine,gain=1.5"]
    assert len({policy["digest"] for policy in policies}) == 3


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("pd.py:Pd", "pd.py has no class 'Pd'; did you mean PD? it has Helper, PD"),
        ("pd.py:PD,lead", "parameters must be name=value, separated by commas; got 'lead'"),
        ("pd.py:PD,gian=3", "PD has no parameter 'gian'; did you mean gain? it has gain, lead"),
        ("pd.py:Helper,gain=3", "Helper has no parameter 'gain'; it has none"),
        ("nowhere.py:PD", "cannot read nowhere.py: No such file or directory"),
        ("pd.py", "a policy to copy must be file.py:Class,parameters or file.onnx, got 'pd.py'"),
        ("blend", "a policy to copy must be file.py:Class,parameters or file.onnx, got 'blend'"),
        ("bad.py:PD", "bad.py is not Python: "),
    ],
)
def test_what_cannot_be_taken_is_one_line_and_nothing_is_written(colift, pd, tmp_path, text, told):
    (tmp_path / "bad.py").write_text("class PD(:\n")
    done = colift("new", "mine", "--from", text)
    assert done.returncode == 2
    assert done.stderr.startswith(f"error: {told}")
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "mine").exists()


def test_check_says_how_a_file_becomes_a_folder(colift, pd):
    done = colift("check", "pd.py", COLUMNS="200")
    assert done.returncode == 1
    assert "'colift new DIR --from pd.py:PD' makes one from it" in done.stdout


def test_a_folder_is_listed_and_drawn_as_a_name_is(colift, pd, tmp_path):
    colift("new", "mine", "--from", "pd.py:PD,lead=0.25")
    told = colift("list", "mine").stdout
    for line in (
        "mine by Your Name",
        "Goes where the human is going.",
        "It sets lead=0.25.",
        "  gain=1.5  a number",
        "  lead=0.1  a number",
        "colift run mine,lead=0.1",
    ):
        assert line in told
    done = colift("render", "mine,gain=1", "--out", "lift.html")
    assert done.returncode == 0, done.stderr
    assert '"policy": "mine,gain=1"' in (tmp_path / "lift.html").read_text().replace('":"', '": "')


def test_a_class_is_listed_without_being_run_here(colift, tmp_path):
    (tmp_path / "nosy.py").write_text(
        "from pathlib import Path\n"
        f"Path({str(tmp_path / 'trace')!r}).write_text('I was here')\n" + PD
    )
    done = colift("list", "nosy.py:PD")
    assert done.returncode == 2
    assert not (tmp_path / "trace").exists()


@pytest.mark.parametrize("suffix", ["html", "png", "gif"])
@pytest.mark.parametrize(
    ("policy", "code", "told"),
    [
        ("bledn", 2, "error: unknown policy 'bledn'; did you mean blend? ('colift list' "),
        ("nowhere/mine", 2, "error: nowhere/mine: no such folder"),
        ("late.py:Late", 1, "nothing to draw: the policy failed: step 3: ZeroDivisionError"),
        ("late.py:Early", 1, "nothing to draw: the policy failed: start: ZeroDivisionError"),
        ("late.py:Never", 2, "error: policy Never: ZeroDivisionError"),
    ],
)
def test_what_cannot_be_drawn_leaves_no_file(colift, tmp_path, policy, code, told, suffix):
    (tmp_path / "late.py").write_text(
        "class Late:\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation): return 0 // int(observation[4] < 0.25)\n"
        "class Early(Late):\n    def reset(self, seed): 1 / 0\n"
        "class Never(Late):\n    def __init__(self): 1 / 0\n"
    )
    done = colift("render", policy, "--out", f"lift.{suffix}")
    assert (done.returncode, done.stdout) == (code, "")
    assert done.stderr.startswith(told)
    assert not (tmp_path / f"lift.{suffix}").exists()
