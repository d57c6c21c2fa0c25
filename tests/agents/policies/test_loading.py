import pickle

import pytest
from colift.agents.errors import InputError
from colift.agents.policies.hold import Hold
from colift.agents.policies.loading import PolicySpec
from colift.agents.registry import POLICIES, entries

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
    ("text", "name"), [("hold", "hold"), ("a.b:Mine", "Mine"), ("/x/y.py:Mine", "Mine")]
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


def test_digest_is_of_the_source(written):
    first = PolicySpec(text=f"{written(GOOD)}:Mine").digest()
    assert len(first) == 16
    assert PolicySpec(text=f"{written(GOOD, 'other.py')}:Mine").digest() == first
    assert PolicySpec(text=f"{written(GOOD + '# more', 'third.py')}:Mine").digest() != first


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("nobody", r"unknown policy 'nobody'; known: .*blend.*hold"),
        ("no_such_module:Mine", r"cannot import module 'no_such_module'"),
        ("colift.agents.policies.hold:Held", r"has no class 'Held'; it has Hold"),
        ("colift.agents.errors:nothing", r"has no class 'nothing'; it has InputError"),
        ("colift.agents.policies.q_learning:state_of", r"is not a class"),
        ("colift.agents.policies.q_learning:QLearner", r"has no method reset\(\)"),
        ("no/such/file.py:Mine", r"no such file: no/such/file\.py"),
        ("mine.py", r"which class of mine\.py\? Say mine\.py:Class"),
        ("folder/mine", r"which class of folder/mine\?"),
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
