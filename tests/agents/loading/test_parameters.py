from dataclasses import dataclass, field
from typing import Literal

import pytest
from colift.agents.loading.parameters import make_with, parameters_of, read_values
from colift.agents.policies.blend import Blend
from colift.agents.policies.hold import Hold
from colift.base.errors import InputError


@dataclass(frozen=True, kw_only=True)
class Inner:
    noise: float = 1.0
    spread: tuple[float, float] = (1.0, 2.0)


@dataclass(frozen=True, kw_only=True)
class Settings:
    low: float = 0.0
    high: float = 1.0
    mode: Literal["calm", "wild"] = "calm"
    inner: Inner = field(default_factory=lambda: Inner(noise=7.0))
    table: list = field(default_factory=list)

    def __post_init__(self):
        if not self.low < self.high:
            raise InputError(f"low must be below high, got {self.low} and {self.high}")


class Mine:
    def __init__(
        self,
        *,
        parameters: Settings | None = None,
        other: Inner = Inner(noise=3.0),
        gain: float = 0.5,
        steps=3,
        label: str | None = None,
        anything=None,
        **rest,
    ):
        self.parameters = parameters or Settings()
        self.given = parameters
        self.other, self.gain, self.steps, self.label = other, gain, steps, label


def made(text):
    return make_with(Mine, read_values(Mine, text))


def test_names_and_defaults():
    defaults = {name: parameter.default for name, parameter in parameters_of(Mine).items()}
    assert defaults == {
        "low": 0.0,
        "high": 1.0,
        "mode": "calm",
        "inner.noise": 7.0,
        "inner.spread": (1.0, 2.0),
        "other.noise": 3.0,
        "other.spread": (1.0, 2.0),
        "gain": 0.5,
        "steps": 3,
        "label": None,
    }


def test_the_owner_is_where_the_docstring_is():
    known = parameters_of(Mine)
    assert (known["inner.noise"].owner, known["inner.noise"].name) == (Inner, "noise")
    assert (known["low"].owner, known["gain"].owner) == (Settings, Mine)


def test_a_field_of_the_parameters():
    policy = made("high=2.5")
    assert policy.parameters == Settings(high=2.5)
    assert policy.gain == 0.5


def test_a_field_inside_keeps_its_neighbours_defaults():
    assert made("inner.spread=3/4").parameters.inner == Inner(noise=7.0, spread=(3.0, 4.0))
    assert made("other.spread=3/4").other == Inner(noise=3.0, spread=(3.0, 4.0))


def test_plain_arguments():
    policy = made("gain=2, steps=4, label=a b")
    assert (policy.gain, policy.steps, policy.label) == (2.0, 4, "a b")
    # What is not named is the constructor's own affair.
    assert policy.given is None


def test_everything_is_set_at_once():
    # Each of the two alone would be refused.
    policy = made("low=3,high=4,mode=w,inner.noise=2")
    assert policy.parameters == Settings(low=3, high=4, mode="wild", inner=Inner(noise=2.0))


def test_nothing_is_shared():
    assert made("low=-1").parameters.low == -1.0
    assert made("gain=1").parameters.low == 0.0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "lo=1",
            r"no parameter 'lo'; did you mean low\? it has low=0, high=1, mode=calm, ",
        ),
        (
            "inner=1",
            r"no parameter 'inner'; did you mean inner\.\w+\? it has .*inner\.spread=1/2",
        ),
        ("parameters.low=1", r"no parameter 'parameters.low'"),
        ("table=1", r"no parameter 'table'"),
        ("rest=1", r"no parameter 'rest'"),
        ("low", r"name=value, separated by commas; got 'low'"),
        ("low=1,", r"name=value, separated by commas; got ''"),
        ("=1", r"name=value, separated by commas; got '=1'"),
        ("low=", r"low must be a number, got ''"),
        ("low=nan", r"low must be a number, got 'nan'"),
        ("mode=c,mode=w", r"mode is given twice"),
        ("mode=mad", r"mode must be one of 'calm', 'wild', got 'mad'"),
        ("steps=0.5", r"steps must be a whole number, got '0.5'"),
        ("inner.noise=loud", r"inner\.noise must be a number, got 'loud'"),
        ("inner.spread=1/2/3", r"inner\.spread must be 2 values with / between, each a number"),
    ],
)
def test_what_cannot_be_read_is_named(text, message):
    with pytest.raises(InputError, match=message):
        read_values(Mine, text)


def test_a_dataclass_has_the_last_word():
    with pytest.raises(InputError, match=r"low must be below high, got 5.0 and 1.0"):
        made("low=5")


def test_a_policy_without_parameters_says_so():
    assert parameters_of(Hold) == {}
    with pytest.raises(InputError, match="no parameter 'gain'; it has none"):
        read_values(Hold, "gain=1")


def test_a_policy_that_is_a_dataclass():
    @dataclass
    class Plain:
        gain: float = 0.5
        inner: Inner = field(default_factory=Inner)

    policy = make_with(Plain, read_values(Plain, "gain=2,inner.noise=4"))
    assert policy == Plain(gain=2.0, inner=Inner(noise=4.0))


def test_types_that_do_not_exist_are_named():
    class Lost:
        def __init__(self, gain: "Nowhere" = 1.0): ...  # noqa: F821

    with pytest.raises(InputError, match=r"cannot read the types of .*Lost.__init__: NameError"):
        parameters_of(Lost)


def test_a_dataclass_needs_defaults():
    @dataclass(frozen=True)
    class Bare:
        gain: float

    class Needy:
        def __init__(self, parameters=None): ...

        __init__.__annotations__["parameters"] = Bare | None

    with pytest.raises(InputError, match="Bare needs a default for every field"):
        parameters_of(Needy)


def test_the_papers_policy_can_be_varied():
    assert {"forgetting", "reading", "confidence", "window", "motion.process_noise"} <= set(
        parameters_of(Blend)
    )
