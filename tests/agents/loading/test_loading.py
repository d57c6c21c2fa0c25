import pickle

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.policies.hold import Hold
from colift.base.errors import InputError
from colift.base.registry import POLICIES, entries

GOOD = """
class Mine:
    def reset(self, seed): pass
    def act(self, observation): return observation[:1]
"""


@pytest.fixture
def written(tmp_path):
    """Write a policy file and return its path."""

    def write(text, name="mine.py"):
        path = tmp_path / name
        path.write_text(text)
        return path

    return write


def test_by_registered_name():
    assert PolicySpec(text="hold").load() is Hold
    assert isinstance(PolicySpec(text="hold").make(), Hold)


def test_by_module():
    assert PolicySpec(text="colift.agents.policies.hold:Hold").load() is Hold


def test_by_file(written):
    spec = PolicySpec(text=f"{written(GOOD)}:Mine")
    policy = spec.make()
    policy.reset(0)
    assert policy.act([0.25, 0.5]) == [0.25]


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("hold", "hold"),
        ("a.b:Mine", "Mine"),
        ("/x/y.py:Mine", "Mine"),
        ("blend,forgetting=0.9", "blend,forgetting=0.9"),
        ("a.b:Mine,gain=2,tag=a:b", "Mine,gain=2,tag=a:b"),
        ("/x,z=1/y.py:Mine,gain=2", "Mine,gain=2"),
    ],
)
def test_name_for_tables(text, name):
    assert PolicySpec(text=text).name == name


def test_every_registered_policy_can_be_made():
    assert {"blend", "copy", "hold", "proactive", "random", "reactive"} <= set(entries(POLICIES))
    for name in entries(POLICIES):
        PolicySpec(text=name).make().reset(0)


def test_travels_to_another_process():
    spec = PolicySpec(text="hold")
    assert pickle.loads(pickle.dumps(spec)) == spec


def test_digest_is_of_what_the_source_does(written):
    first = PolicySpec(text=f"{written(GOOD)}:Mine").digest()
    assert len(first) == 16
    assert PolicySpec(text=f"{written(GOOD, 'other.py')}:Mine").digest() == first
    assert PolicySpec(text=f"{written(GOOD + '# more', 'third.py')}:Mine").digest() == first
    assert PolicySpec(text=f"{written(GOOD + 'MORE = 1', 'fourth.py')}:Mine").digest() != first


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("nobody", "^unknown policy 'nobody'$"),
        ("no_such_module:Mine", r"cannot import module 'no_such_module'"),
        ("colift.agents.policies.hold:Held", r"has no class 'Held'; it has Hold"),
        ("colift.base.errors:nothing", r"has no class 'nothing'; it has .*InputError"),
        ("colift.agents.control.q_learning:state_of", r"is not a class"),
        ("colift.agents.control.q_learning:QLearner", r"has no method reset\(\)"),
        ("no/such/file.py:Mine", r"no such file: no/such/file\.py"),
        ("mine.py", r"mine\.py names no class; give mine\.py:Class"),
        ("folder/mine", r"folder/mine names no class"),
    ],
)
def test_what_cannot_be_found_is_named(text, message):
    with pytest.raises(InputError, match=message):
        PolicySpec(text=text).load()


@pytest.mark.parametrize(
    ("source", "message"),
    [
        ("class Other: pass", r"has no class 'Mine'; it has Other$"),
        ("x = 1", r"has no class 'Mine'$"),
        ("Mine = 3", r"Mine is not a class"),
        ("class Mine:\n    def act(self, o): pass", r"has no method reset\(\)"),
        ("class Mine:\n    def reset(self, s): pass", r"has no method act\(\)"),
        (
            GOOD + "    def __init__(self, gain, *, speed, ok=1, **rest): pass",
            r"needs arguments: gain, speed; give them defaults",
        ),
        ("raise RuntimeError('boom')", r"fails on import: RuntimeError: boom"),
        ("class Mine(", r"fails on import: SyntaxError"),
        ("import no_such_module", r"fails on import: ModuleNotFoundError"),
    ],
)
def test_a_file_that_holds_no_policy_says_why(written, source, message):
    with pytest.raises(InputError, match=message):
        PolicySpec(text=f"{written(source)}:Mine").load()


def test_defaults_are_no_needed_arguments(written):
    source = GOOD + "    def __init__(self, gain=2, *more, speed=1, **rest): self.gain = gain"
    assert PolicySpec(text=f"{written(source)}:Mine").make().gain == 2


TUNABLE = """
class Mine:
    def __init__(self, gain: float = 0.5, tag: str = ""):
        if gain < 0: raise ValueError(f"gain must not be negative, got {gain}")
        if gain > 9: raise RuntimeError("too hot")
        self.gain, self.tag = gain, tag
    def reset(self, seed): pass
    def act(self, observation): return self.gain * observation[:1]
"""


def largest_step(policy):
    policy.reset(0)
    return max(abs(policy.act(np.full(5, 0.1))[0]) for _ in range(50))


def test_parameters_of_a_registered_policy():
    spec = PolicySpec(text="random,step=0.001")
    spec.check()
    assert largest_step(spec.make()) <= 0.001 < largest_step(PolicySpec(text="random").make())


def test_parameters_of_a_module_and_of_a_file(written):
    by_module = PolicySpec(text="colift.agents.policies.random:Random,step=0.001").make()
    assert largest_step(by_module) <= 0.001
    policy = PolicySpec(text=f"{written(TUNABLE)}:Mine,gain=2,tag=x=y:z").make()
    assert (policy.gain, policy.tag) == (2.0, "x=y:z")


def test_a_path_may_hold_commas_and_equals_signs(written):
    path = written(TUNABLE, "a,gain=1.py")
    assert PolicySpec(text=f"{path}:Mine").make().gain == 0.5
    assert PolicySpec(text=f"{path}:Mine,gain=2").make().gain == 2.0


def test_a_variant_travels_to_another_process():
    spec = PolicySpec(text="blend,forgetting=0.9")
    assert pickle.loads(pickle.dumps(spec)) == spec


def test_digest_covers_the_parameters_however_they_are_written():
    def digest(text):
        return PolicySpec(text=text).digest()

    plain, variant = digest("blend"), digest("blend,forgetting=0.9,reading=standard")
    assert len(variant) == 16
    assert len({plain, variant, digest("blend,forgetting=0.9"), digest("blend,window=6")}) == 4
    assert digest("blend, reading=standard deviation as rho, forgetting=9e-1") == variant


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ("", r"policy .*mine\.py:Mine: parameters must be name=value, separated by commas; got ''"),
        (
            "gian=1",
            r"policy .*mine\.py:Mine: no parameter 'gian'; did you mean gain\? it has gain=0.5",
        ),
        ("gain=x", r"policy .*mine\.py:Mine: gain must be a number, got 'x'"),
        ("gain=-1", r"policy .*mine\.py:Mine: gain must not be negative, got -1.0"),
        ("gain=10", r"policy .*mine\.py:Mine: RuntimeError: too hot"),
    ],
)
def test_wrong_parameters_are_refused_before_a_run(written, parameters, message):
    spec = PolicySpec(text=f"{written(TUNABLE)}:Mine,{parameters}")
    with pytest.raises(InputError, match=message):
        spec.check()
    with pytest.raises(InputError, match=message):
        spec.make()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("blend,forgetting=2", r"policy blend: forgetting must be in \(0, 1\], got 2.0"),
        ("blend,forgeting=1", r"policy blend: no parameter 'forgeting'; .*forgetting=0.45"),
        ("hold,gain=1", r"policy hold: no parameter 'gain'; it has none"),
        ("nobody,gain=1", "^unknown policy 'nobody'$"),
        ("mine.py,gain=1", r"mine\.py names no class; give mine\.py:Class"),
    ],
)
def test_wrong_variants_are_named(text, message):
    with pytest.raises(InputError, match=message):
        PolicySpec(text=text).check()
