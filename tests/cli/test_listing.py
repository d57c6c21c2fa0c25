import json
import re
from dataclasses import dataclass

import pytest
from colift.agents.loading.description import described, field_docstrings
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.registry import summary
from colift.cli.listing import SECTIONS
from colift.listing import list_policies


@dataclass
class Base:
    speed: float = 1.0
    """How fast
    it goes [m/s]."""
    bare: int = 0


@dataclass
class Derived(Base):
    """Not a field's."""

    speed: float = 2.0
    """Faster."""
    size: float = 1.0
    """How large."""


def test_docstrings_are_read_from_under_the_fields():
    assert field_docstrings(Base) == {"speed": "How fast it goes [m/s]."}
    assert field_docstrings(Derived) == {"speed": "Faster.", "size": "How large."}


def test_a_class_without_source_has_none():
    assert field_docstrings(int) == {}


def test_list_tells_a_policys_parameters_with_units(colift):
    code, out, err = colift("list", "blend")
    assert (code, err) == (0, "")
    for told in (
        "Leads in proportion to",
        "  forgetting=0.45  a number",
        "phi of eq. 7",
        "  motion.initial_deviation=0.83666/10/100  3 values",
        "the variance of a measured height [mm2]",
        "'standard deviation",
        "colift run blend,",
    ):
        assert told in out


def test_a_policy_of_ones_own_is_listed_and_varied(colift, tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(
        "class Mine:\n"
        "    'Lifts.'\n"
        "    def __init__(self, gain: float = 0.5): self.gain = gain\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation): return self.gain * (observation[:1] - observation[3])\n"
    )
    assert "gain=0.5  a number" in colift("list", f"{path}:Mine")[1]
    options = ("--suite", "quick-v1", "--seeds", "0:1", "--jobs", "1", "--json")
    half, full = (
        json.loads(colift("run", f"{path}:Mine,gain={gain}", *options)[1]) for gain in ("0.5", "1")
    )
    assert full["policy"]["name"] == "Mine,gain=1"
    assert full["policy"]["digest"] != half["policy"]["digest"]
    assert full["summary"]["rmse_mm"]["mean"] < half["summary"]["rmse_mm"]["mean"]


def test_a_policy_without_parameters_is_listed(colift):
    assert "It has no parameters." in colift("list", "hold")[1]


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["list", "nobody"], "unknown policy 'nobody'"),
        (["run", "blend,forgeting=0.9"], "it has motion.measurement_noise=0.7"),
        (["run", "blend,forgetting=often"], "policy blend: forgetting must be a number"),
        (["run", "blend,forgetting=2"], "policy blend: forgetting must be in (0, 1], got 2.0"),
    ],
)
def test_what_is_wrong_is_one_line_and_exit_code_2(colift, arguments, told):
    code, _, err = colift(*arguments)
    assert code == 2
    assert told in err
    assert err.startswith("error:")
    assert err.count("\n") == 1


@pytest.mark.parametrize("section", SECTIONS)
def test_each_section_can_be_listed_alone(colift, section):
    alone, every = (colift("list", *words, COLUMNS="250") for words in ((section,), ()))
    assert (alone.returncode, alone.stderr) == (0, "")
    titles = [line for line in alone.stdout.splitlines() if not line.startswith(" ")]
    assert all(each.lower().endswith(section) or section == "policies" for each in titles)
    shown, listed = (
        {" ".join(line.split()) for line in done.stdout.splitlines()} for done in (alone, every)
    )
    assert shown < listed


@pytest.mark.parametrize(
    ("named", "section"), [("polices", "policies"), ("task", "tasks"), ("Suites", "suites")]
)
def test_a_section_that_is_misspelt_is_suggested(colift, named, section):
    code, _, err = colift("list", named)
    assert code == 2
    assert f"unknown policy '{named}'" in err
    assert f"'colift list {section}'" in err


@pytest.mark.parametrize("name", list_policies())
def test_a_description_has_words_and_no_markup(name):
    policy = PolicySpec(text=name).load()
    told = [summary(policy), *(each.meaning for each in described(policy))]
    assert [each for each in told if re.search(r"`|:[a-z]+:", each)] == []


def test_policies_for_one_task_have_a_section_of_their_own(colift):
    code, out, _ = colift("list")
    assert code == 0
    common, _, rest = out.partition("Policies for the task intent")
    own, _, _ = rest.partition("Human behaviours")
    for name in ("pose_bayes", "pose_wrist"):
        assert name in own
        assert name not in common
    assert "anticipate" in common


def test_the_policies_of_a_task_are_those_for_any_and_its_own():
    level, intent, every = (set(list_policies(task)) for task in ("level", "intent", None))
    assert intent - level >= {"pose_bayes", "touch_level"}
    assert level < intent <= every
