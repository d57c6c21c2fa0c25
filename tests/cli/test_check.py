"""``colift check`` and ``colift run`` on a submission, as a user meets them: real processes."""

import json
from pathlib import Path

import pytest
from colift.agents.sandbox.host.policy import close_sandboxes
from colift.agents.submissions.new import write_template
from colift.cli.check import all_checks

from ..agents.sandbox.keeping import COUNTING

pytestmark = pytest.mark.slow

HEAD = "import sys\nclass Policy:\n"

ACTING = HEAD + "    def reset(self, seed): pass\n    def act(self, o): return "


@pytest.fixture
def mine(tmp_path):
    folder = tmp_path / "mine"
    write_template(folder)
    return folder


@pytest.fixture
def checked(mine, tmp_path, monkeypatch):
    """Write a policy and return its checks by name: what the command prints, in real sandboxes."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))

    def check(source):
        (mine / "policy.py").write_text(source)
        return {each.name: each for each in all_checks(mine, None, trusted=False, jobs=1)}

    yield check
    close_sandboxes()


def checks(done):
    return {each["name"]: each for each in json.loads(done.stdout)["checks"]}


def test_the_life_of_a_submission(colift, tmp_path):
    assert "colift check mine" in colift("new", "mine").stdout
    manifest = tmp_path / "mine" / "policy.toml"
    manifest.write_text(manifest.read_text().replace("Your Name", "Ada Lovelace"))
    checked = colift("check", "mine")
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert "mine by Ada Lovelace; licence MIT" in checked.stdout
    assert "equal to the bit" in " ".join(checked.stdout.split())
    assert "failed" not in checked.stdout
    last = checked.stdout.splitlines()[-1]
    assert last == "Next: colift run mine, or colift submit mine --board PATH"
    ran = colift("run", "mine", "--suite", "quick-v1")
    assert ran.returncode == 0, ran.stderr
    (error,) = (line for line in ran.stdout.splitlines() if line.startswith("RMSE "))
    assert error in " ".join(checked.stdout.split())


def test_json_is_alone_on_stdout_and_has_the_results_of_run_in_a_sandbox_or_without(colift, mine):
    done = colift("check", "mine", "--json")
    content = json.loads(done.stdout)
    assert (done.returncode, content["ok"]) == (0, True)
    assert list(checks(done)) == [
        "files",
        "manifest",
        "packages",
        "interface",
        "lifts",
        "determinism",
        "score",
        "actions",
        "time",
    ]
    run = json.loads(colift("run", "mine", "--suite", "quick-v1", "--json").stdout)
    bare = json.loads(colift("check", "mine", "--json", "--isolation", "none").stdout)["results"]
    for each in (run, bare, content["results"]):
        del each["summary"]["step_ms"]
    assert run == content["results"]
    assert bare.pop("isolation") == "none" != run.pop("isolation")
    assert bare == run


FAILING = {
    "wrong syntax": ("class Policy:\n  def\n", "interface", "SyntaxError"),
    "no class": ("class Other: pass\n", "interface", "has no class 'Policy'; it has Other"),
    "no act": (HEAD + "    def reset(self, seed): pass\n", "interface", "no method act"),
    "needs arguments": (
        HEAD
        + "    def __init__(self, size): pass\n"
        + "    def reset(self, seed): pass\n"
        + "    def act(self, observation): pass\n",
        "interface",
        "needs arguments: size",
    ),
    "raises on import": ("raise KeyError('gone')\n", "interface", "KeyError: 'gone'"),
    "exits on import": ("import sys\nsys.exit(3)\n", "interface", "SystemExit: 3"),
    "raises in reset": (
        HEAD
        + "    def reset(self, seed): raise RuntimeError('not ready')\n"
        + "    def act(self, observation): return [0.0]\n",
        "interface",
        "RuntimeError: not ready",
    ),
    "two numbers": (
        HEAD
        + "    def reset(self, seed): pass\n"
        + "    def act(self, observation): return [0.0, 0.0]\n",
        "lifts",
        "must be 1 number, got [0.0, 0.0]",
    ),
    "not a number": (
        HEAD
        + "    def reset(self, seed): pass\n"
        + "    def act(self, observation): return [float('nan')]\n",
        "lifts",
        "must be finite",
    ),
    "later": (
        HEAD
        + "    def reset(self, seed): pass\n"
        + "    def act(self, observation):\n"
        + "        if observation[4] > 0.35: print('loud'); print('soft', file=sys.stderr); 1 / 0\n"
        + "        return [0.0]\n",
        "lifts",
        "smooth/S1 seed 7000: step 4: ZeroDivisionError",
    ),
}


@pytest.mark.parametrize("case", FAILING)
def test_what_fails_is_reported_with_the_reason(checked, case):
    source, name, told = FAILING[case]
    found = checked(source)
    assert list(found)[-1] == name
    assert [each.name for each in found.values() if not each.ok] == [name]
    assert told in found[name].message


def test_a_failure_is_shown_with_what_was_printed_and_what_to_do(colift, mine):
    (mine / "policy.py").write_text(FAILING["later"][0])
    done = colift("check", "mine", COLUMNS="60")
    lines = [line.strip() for line in done.stdout.splitlines()]
    assert "loud" in lines
    assert lines[-1] == "1 check failed. Fix the submission, then: colift check mine"
    assert any(line.startswith("failed  lifts        smooth/S1 seed 7000") for line in lines)
    told, _, printed = done.stdout.partition("it printed:\n")
    assert all(len(line) <= 60 for line in told.splitlines())
    assert '\n      File "policy.py", line 5, in act\n' in printed


def test_the_next_commands_are_for_the_suite_that_was_checked(colift, mine):
    done = colift("check", "mine", "--suite", "intent-v1")
    run, submit = "colift run mine --suite intent-v1", "colift submit mine --board PATH"
    assert done.stdout.splitlines()[-1] == f"Next: {run}, or {submit} --suite intent-v1"
    (mine / "policy.py").write_text(FAILING["later"][0])
    done = colift("check", "mine", "--suite", "intent-v1")
    assert done.stdout.splitlines()[-1].endswith("colift check mine --suite intent-v1")


def test_run_shows_where_a_policy_fails(colift, mine):
    (mine / "policy.py").write_text(FAILING["later"][0])
    done = colift("run", "mine", "--suite", "quick-v1", "--seeds", "0:1")
    assert done.returncode == 1
    assert '      File "policy.py", line 5, in act\n' in done.stderr


def test_a_traceback_has_the_policys_own_files_and_lines_alone(checked, mine):
    (mine / "helper.py").write_text("def half(x):\n    return 1 / x\n")
    found = checked("import helper\n" + ACTING + "helper.half(0)\n")
    lines = found["lifts"].printed.splitlines()
    # The marks below the code are others in other versions of Python.
    assert [line for line in lines if line.strip(" ~^")] == [
        "Traceback (most recent call last):",
        '  File "policy.py", line 5, in act',
        "    def act(self, o): return helper.half(0)",
        '  File "helper.py", line 2, in half',
        "    return 1 / x",
        "ZeroDivisionError: division by zero",
    ]


def test_what_fails_on_import_is_reported_with_its_line(checked):
    assert (
        "'gone' (policy.py, line 2)" in checked("\nraise KeyError('gone')\n")["interface"].message
    )


@pytest.mark.parametrize(
    "source",
    [
        "import random\nR = random.Random()\n",
        "import os\n"
        "class R:\n"
        "    random = staticmethod(lambda: int.from_bytes(os.urandom(2), 'big') / 65536)\n",
        "import time\nclass R:\n    random = staticmethod(lambda: time.perf_counter() % 1)\n",
    ],
)
def test_chance_is_found(checked, source):
    found = checked(
        source
        + "class Policy:\n"
        + "    def reset(self, seed): pass\n"
        + "    def act(self, observation): return [R.random() / 1000]\n"
    )
    assert not found["determinism"].ok
    assert "differs from step 0 on" in found["determinism"].message


def test_what_is_kept_from_one_lift_to_the_next_is_found(checked):
    found = checked(
        COUNTING + "class Policy:\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation): return [lifts / 1000]\n"
    )
    assert not found["determinism"].ok
    assert "differs from step 0 on" in found["determinism"].message


def test_millimetres_for_metres_are_warned_of(checked):
    found = checked(ACTING + "1000 * (o[0] - o[3])\n")
    assert all(each.ok for each in found.values())
    assert found["actions"].warning
    assert " % were clipped: the hands move at most 0.04 m per step" in found["actions"].message
    assert "An action must be a change of the height" in found["actions"].message
    assert found["score"].warning
    assert "Worse than copy (goes where the human was, " in found["score"].message


def test_who_is_worse_than_one_that_never_moves_is_told(checked):
    score = checked(ACTING + "-1e-4\n")["score"]
    assert score.ok
    assert score.warning
    assert "Worse than hold (never moves, " in score.message


def test_a_plain_number_is_an_action_and_a_sound_policy_is_not_warned_of(checked):
    found = checked(ACTING + "1.8 * float(o[0] - o[2])\n")
    assert [name for name, each in found.items() if each.warning] == ["manifest"]


def test_the_templates_words_about_itself_are_to_be_replaced(checked, mine):
    told = checked((mine / "policy.py").read_text())["manifest"].message
    assert told.endswith("; boards refuse the author 'Your Name'. Add to policy.toml the authors")
    own = FAILING["no act"][0]
    told = checked(own)["manifest"].message
    assert told.endswith("the authors and a description (it is that of 'colift new')")
    manifest = mine / "policy.toml"
    manifest.write_text(
        manifest.read_text().replace("Your Name", "Ada").replace("Removes a fixed", "Removes a")
    )
    manifested = checked(own)["manifest"]
    assert manifested.message == "mine by Ada; licence MIT"
    assert not manifested.warning


def test_printing_much_is_warned_of(checked):
    found = checked(
        HEAD
        + "    def reset(self, seed): pass\n"
        + "    def act(self, o):\n        print('x' * 200)\n        return 0.0\n"
    )
    assert found["time"].warning
    assert "It prints over 5000 characters" in found["time"].message


def test_an_undeclared_package_fails_though_it_is_installed(checked, mine):
    found = checked((mine / "policy.py").read_text() + "import PIL\n")
    assert not found["packages"].ok
    assert "policy.py imports PIL, which" in found["packages"].message
    assert found["score"].ok


@pytest.mark.parametrize(
    ("spoil", "told"),
    [
        (lambda mine: (mine / "policy.toml").unlink(), "mine has no policy.toml; a submission is"),
        (lambda mine: (mine / "link").symlink_to("/etc/passwd"), "mine: link: a symbolic link"),
        (lambda mine: (mine / "policy.toml").write_text("nam = 1"), "did you mean name?"),
        (lambda mine: (mine / "policy.py").unlink(), "entry_point 'policy:Policy' needs a file"),
    ],
)
def test_a_folder_that_is_no_submission_is_refused(mine, spoil, told):
    spoil(mine)
    (found,) = all_checks(mine, None, trusted=False, jobs=1)
    assert (found.name, found.ok) == ("files", False)
    assert told in found.message


def test_a_class_in_a_file_is_no_submission_and_new_makes_one_of_it(mine):
    (found,) = all_checks(Path(f"{mine / 'policy.py'}:Policy"), None, trusted=False, jobs=1)
    assert "policy.py is a file; a submission is a folder ('colift new DIR --from" in found.message


def test_run_refuses_a_folder_that_is_no_submission(colift, mine):
    (mine / "policy.toml").unlink()
    done = colift("run", "mine")
    assert done.returncode == 2
    assert done.stderr.startswith("error: mine has no policy.toml; a submission is a folder with")


def test_wrong_usage_is_one_clear_line(colift, mine):
    for arguments, told in (
        (["check", "mine", "--isolation", "jail"], "unknown isolation 'jail'; known: auto, bubble"),
        (["check", "mine", "--jobs", "0"], "jobs must be at least 1"),
    ):
        done = colift(*arguments)
        assert done.returncode == 2
        assert told in done.stderr
        assert done.stderr.count("\n") == 1
