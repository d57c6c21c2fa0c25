"""From what a user calls a policy to where it runs."""

import sys

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.sandbox.host.levels import VERIFIABLE, working_levels
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.agents.submissions import choice
from colift.agents.submissions.choice import choose_policy
from colift.agents.submissions.new import write_template
from colift.agents.submissions.trusted import TrustedSubmission
from colift.base.errors import InputError
from colift.benchmark.execution.playing import play
from colift.benchmark.suites.catalogue import make_scenario
from colift.cli.run import run

SOURCE = (
    "from pathlib import Path\n"
    "class Mine:\n"
    "    def __init__(self, gain=1.0): self.gain = gain\n"
    "    def reset(self, seed): pass\n"
    "    def act(self, observation):\n"
    "        return [self.gain * (observation[0] - observation[2])]\n"
    "class Nosy(Mine):\n"
    "    def reset(self, seed):\n"
    "        raise ValueError(sorted(p.name for p in Path(__file__).parent.iterdir()))\n"
)


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    """Work in a folder with a policy's file, a secret and a submission; use a cache of its own."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    folder = tmp_path / "here"
    write_template(folder / "mine")
    (folder / "policy.py").write_text(SOURCE)
    (folder / "secret.txt").write_text("secret")
    monkeypatch.chdir(folder)
    yield folder
    close_sandboxes()


def actions(policy):
    """Return the actions of a lift; the sandbox is a real one."""
    (episode,) = play(policy, make_scenario("smooth"), (3,))
    assert episode.failure is None
    return episode.trace.action.tobytes()


def test_own_policies_by_name_run_in_process():
    assert choose_policy("proportional,gain=2") == PolicySpec(text="proportional,gain=2")
    assert choose_policy("blend").isolation == "none"


@pytest.mark.parametrize(
    "text",
    ["mine", "./mine", "mine/", "policy.py:Mine", "colift.agents.policies.hold:Hold"],
)
def test_everything_else_runs_on_the_strongest_level(text):
    policy = choose_policy(text)
    assert isinstance(policy, SandboxedPolicy)
    assert policy.isolation == working_levels()[0]


def test_policies_of_other_packages_by_name_are_sandboxed(monkeypatch):
    own = choice.own_entries("colift.policies")
    monkeypatch.setattr(
        choice,
        "own_entries",
        lambda group: {name: own[name] for name in own if name != "hold"},
    )
    policy = choose_policy("hold")
    assert isinstance(policy, SandboxedPolicy)
    assert (policy.name, policy.origin) == ("hold", "colift.agents.policies.hold:Hold")


def test_none_is_without_isolation_for_all():
    assert choose_policy("policy.py:Mine", "none") == PolicySpec(text="policy.py:Mine")
    assert choose_policy("blend", "none") == PolicySpec(text="blend")
    assert isinstance(choose_policy("mine", "none"), TrustedSubmission)


@pytest.mark.slow
@pytest.mark.parametrize("text", ["proportional,gain=2", "mine", "policy.py:Mine,gain=1.2"])
def test_a_level_is_for_all_and_changes_no_action(text, each_level):
    policy = choose_policy(text, each_level)
    assert policy.isolation == each_level
    trusted = choose_policy(text, "none")
    assert policy.name == trusted.name
    assert actions(policy) == actions(trusted)


@pytest.mark.parametrize("text", ["proportional,gain=2", "mine", "policy.py:Mine"])
def test_the_digest_does_not_depend_on_the_isolation(text):
    assert choose_policy(text, working_levels()[0]).digest() == choose_policy(text, "none").digest()


def test_parameters_change_the_digest_however_they_are_ordered():
    one, other, again = (
        choose_policy(f"policy.py:Mine,{parameters}").digest()
        for parameters in ("gain=1,size=2", "gain=2,size=2", "size=2, gain=1")
    )
    assert one == again != other
    assert choose_policy("policy.py:Mine").digest() not in (one, other)


def test_a_file_is_alone_in_its_sandbox():
    (episode,) = play(choose_policy("policy.py:Nosy"), make_scenario("smooth"), (3,))
    assert episode.failure == "start: ValueError: ['policy.py']"


def test_a_name_comes_before_a_folder_of_that_name(here):
    write_template(here / "hold")
    assert choose_policy("hold") == PolicySpec(text="hold")
    assert choose_policy("./hold").name == "my-policy"


def test_a_level_that_does_not_work_here_is_refused_with_the_reason(monkeypatch):
    monkeypatch.setattr(choice, "fault", lambda level: "there is no bwrap")
    with pytest.raises(InputError) as caught:
        choose_policy("blend", "bubblewrap")
    assert str(caught.value) == "isolation bubblewrap does not work here: there is no bwrap"


def test_a_module_beside_the_user_is_refused_with_what_to_do(here, monkeypatch):
    monkeypatch.syspath_prepend(here)
    (here / "pack").mkdir()
    (here / "pack" / "__init__.py").write_text("raise SystemExit('I was run')\n")
    (here / "pack" / "inner.py").write_text(SOURCE)
    with pytest.raises(InputError) as caught:
        choose_policy("pack.inner:Mine")
    assert str(caught.value) == (
        f"module 'pack.inner' is {here}/pack/inner.py, which a sandbox does not see: "
        "install its package, not as editable, name the file, as in inner.py:Class, or make it a "
        "submission"
    )
    assert "pack" not in sys.modules


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("nonesuch", "unknown policy 'nonesuch'"),
        ("no/such", "no/such: no such folder"),
        ("policy.py", "policy.py names no class; give policy.py:Mine"),
        ("nowhere.py:Class", "no such file: nowhere.py"),
        ("no.such.module:Class", "cannot import module 'no.such.module'"),
        ("numpy.nonesuch:Class", "cannot import module 'numpy.nonesuch'"),
        ("colift.nonesuch:Class", "cannot import module 'colift.nonesuch'"),
        ("colift.benchmark.episode.lift:Lift", "which a sandbox does not see"),
        ("itertools:count", "module 'itertools' has no source file"),
        ("here", "unknown policy 'here'"),
        (".", ". has no policy.toml; found mine/policy.toml: give the folder that contains it"),
        ("", "unknown policy ''"),
    ],
)
def test_what_is_no_policy_is_refused(text, told):
    with pytest.raises(InputError) as caught:
        choose_policy(text)
    assert told in str(caught.value)


def test_an_unknown_isolation_is_refused_with_all_there_are():
    with pytest.raises(InputError, match="known: auto, bubblewrap, landlock, limits, none"):
        choose_policy("blend", "jail")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("policy.py:Main", "policy.py has no class 'Main'; it has Mine, Nosy"),
        ("policy.py:Mine,size=2", "no parameter 'size'; it has gain=1"),
        ("colift.agents.agent:FRAME", "not a class"),
    ],
)
def test_what_only_the_sandbox_can_tell_is_told_by_its_check(text, told):
    with pytest.raises(InputError) as caught:
        choose_policy(text).check()
    assert told in str(caught.value)


@pytest.mark.slow
def test_a_run_says_what_kept_the_policy_apart(each_level, tmp_path, capsys):
    write_template(tmp_path / "mine")
    run(str(tmp_path / "mine"), suite="quick-v1", seeds="0:1", isolation=each_level, jobs=1)
    told = capsys.readouterr().out
    assert f"Isolation: {each_level}" in told
    assert ("not enough for a verified row" in told) == (each_level not in VERIFIABLE)
