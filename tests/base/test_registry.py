"""Finding policies by name, and what holds for every policy that is found."""

import re

import numpy as np
import pytest
from colift.agents.agent import Explaining
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.policies.hold import Hold
from colift.base.errors import InputError, Remedy
from colift.base.registry import (
    POLICIES,
    REMEMBERING,
    TASKS,
    _contested,
    entries,
    lookup,
    own_entries,
    summary,
)
from colift.benchmark.suites.catalogue import make_task
from colift.testing import check_policy

NAMES = tuple(entries(POLICIES))


def views(seed=0):
    """Return what a robot sees of a lift, with a hand that lags."""
    rng = np.random.default_rng(seed)
    k = np.arange(40)
    human = 0.1 * (1 - np.cos(np.pi * k / 39))
    hand = np.concatenate(([0.0], human[:-1]))
    seen = np.column_stack((human, hand, hand, hand, 0.1 * k))
    seen[:, :3] += rng.normal(0.0, 2e-4, (40, 3))
    return seen


def run(policy, seen, seed=3):
    policy.reset(seed)
    return np.array([policy.act(view) for view in seen])


def forget():
    entries.cache_clear()
    _contested.cache_clear()


@pytest.fixture
def install(tmp_path, monkeypatch):
    """Install a distribution that registers policies, for the time of a test."""

    def put(name, entry_points):
        about = tmp_path / f"{name}-1.0.dist-info"
        about.mkdir()
        about.joinpath("METADATA").write_text(
            f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n"
        )
        about.joinpath("entry_points.txt").write_text(f"[{POLICIES}]\n{entry_points}\n")
        monkeypatch.syspath_prepend(tmp_path)
        forget()

    yield put
    monkeypatch.undo()
    forget()


def test_another_labs_policy_is_found_like_ours(install, tmp_path):
    tmp_path.joinpath("otherlab_lifting.py").write_text(
        "class Lifter:\n"
        "    '''Lifts like the other lab.'''\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation): return observation[:1]\n"
    )
    install("otherlab", "lifter = otherlab_lifting:Lifter")
    assert set(entries(POLICIES)) == {*NAMES, "lifter"}
    policy = PolicySpec(text="lifter").make()
    assert summary(type(policy)) == "Lifts like the other lab."
    assert run(policy, views()).shape == (40, 1)


def test_an_uninstalled_policy_is_gone():
    assert "lifter" not in tuple(entries(POLICIES))


def test_a_name_that_two_packages_register_is_refused_and_no_other(install):
    install("otherlab", "blend = otherlab_lifting:Blend")
    fault = (
        "policy 'blend' is registered 2 times: colift.agents.policies.blend:Blend of the package "
        "colift, otherlab_lifting:Blend of the package otherlab"
    )
    with pytest.raises(InputError, match=re.escape(fault)):
        lookup(POLICIES, "blend")
    assert isinstance(PolicySpec(text="hold").make(), Hold)
    assert own_entries(POLICIES)["blend"].module == "colift.agents.policies.blend"


def test_the_same_entry_found_twice_is_one(install):
    install("copied", "hold = colift.agents.policies.hold:Hold")
    assert tuple(entries(POLICIES)) == NAMES


def test_an_unknown_name_is_told_near_names_or_the_few_that_there_are():
    with pytest.raises(InputError) as error:
        lookup(POLICIES, "blnd")
    assert str(error.value) == "unknown policy 'blnd'; did you mean blend?"
    assert error.value.remedy == Remedy.LIST
    with pytest.raises(InputError, match="unknown task 'hold'; known: agree, ball, "):
        lookup(TASKS, "hold")


def test_a_package_that_cannot_be_loaded_is_named(install):
    install("otherlab", "lifter = no_such_module:Lifter")
    with pytest.raises(
        InputError,
        match=r"policy 'lifter' \(no_such_module:Lifter\) of the package otherlab cannot be "
        "loaded: ModuleNotFoundError",
    ):
        lookup(POLICIES, "lifter")


def test_names_are_in_order():
    assert list(NAMES) == sorted(NAMES)
    assert len(NAMES) >= 6


@pytest.mark.parametrize("name", NAMES)
def test_every_policy_conforms_and_has_a_line_to_be_listed(name):
    group = entries(POLICIES)[name].group
    task = "level" if group in (POLICIES, REMEMBERING) else group.removeprefix(f"{POLICIES}.")
    check_policy(PolicySpec(text=name).make, make_task(task))
    assert summary(lookup(POLICIES, name)).endswith((".", ")."))


def test_blend_and_proactive_explain_themselves():
    for name in ("blend", "proactive"):
        assert isinstance(PolicySpec(text=name).make(), Explaining)
