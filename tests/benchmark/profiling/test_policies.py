"""The time of a policy's steps."""

import time

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.spec import InProcess
from colift.base.errors import InputError
from colift.benchmark.profiling.policies import LIMIT_MS, StepTime, default_scenarios, step_time


class Slow:
    """Holds still; takes at least 2 ms, and 20 ms in the first step of an episode."""

    def reset(self, seed: int) -> None:
        self._first = True

    def act(self, observation: object) -> np.ndarray:
        time.sleep(0.02 if self._first else 0.002)
        self._first = False
        return np.zeros(1)


class Broken:
    def reset(self, seed: int) -> None:
        pass

    def act(self, observation: object) -> np.ndarray:
        raise ValueError("broken")


class Spec(InProcess):
    def __init__(self, policy: type) -> None:
        self._policy = policy
        self.name = policy.__name__

    def check(self) -> None:
        pass

    def digest(self) -> str:
        return ""

    def make(self) -> object:
        return self._policy()


SMOOTH = default_scenarios()[:1]


def test_a_slow_policy_has_a_slow_median_and_a_slower_tail() -> None:
    taken = step_time(Spec(Slow), SMOOTH, seeds=(0,))
    assert taken is not None
    assert taken.policy == "Slow"
    assert taken.median_ms >= 2.0
    assert taken.p99_ms > 4.0
    assert taken.steps > 30


def test_every_behaviour_is_timed() -> None:
    one = step_time(PolicySpec(text="hold"), SMOOTH, seeds=(0,))
    every = step_time(PolicySpec(text="hold"), default_scenarios(), seeds=(0,))
    assert one is not None
    assert every is not None
    assert [s.behaviour for s in default_scenarios()] == [
        "smooth",
        "pause",
        "jerky",
        "changing_goal",
    ]
    assert every.steps > 3 * one.steps
    assert 0.0 < one.median_ms <= one.p99_ms


def test_a_policy_that_never_makes_a_step_has_no_time() -> None:
    assert step_time(Spec(Broken), SMOOTH, seeds=(0,)) is None


def test_the_limit_is_on_the_tail() -> None:
    quick = StepTime(policy="a", steps=9, median_ms=0.1, p99_ms=LIMIT_MS)
    late = StepTime(policy="a", steps=9, median_ms=0.1, p99_ms=LIMIT_MS + 0.1)
    assert quick.within_limit
    assert not late.within_limit


def test_an_unknown_policy_is_refused() -> None:
    with pytest.raises(InputError, match="nonesuch"):
        step_time(PolicySpec(text="nonesuch"), SMOOTH)
