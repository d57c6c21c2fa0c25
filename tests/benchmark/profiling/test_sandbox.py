"""What isolation costs."""

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest
from colift.agents.sandbox.host.levels import working_levels
from colift.agents.sandbox.host.policy import close_sandboxes
from colift.benchmark.profiling.sandbox import (
    EPISODE_MS,
    STEP_US,
    IsolationCost,
    isolated,
    isolation_cost,
)


class Still:
    def __init__(self, step: float) -> None:
        self._step = step

    def reset(self, seed: int) -> None:
        pass

    def act(self, observation: object) -> np.ndarray:
        if self._step:  # To sleep for no time lets others have the processor for some.
            time.sleep(self._step)
        return np.zeros(1)


class Spec:
    name, isolation = "still", "none"

    def __init__(self, start: float, step: float) -> None:
        self._start = start
        self._step = step

    def digest(self) -> str:
        return ""

    def check(self) -> None:
        pass

    @contextmanager
    def agent(self) -> Iterator[Still]:
        time.sleep(self._start)
        yield Still(self._step)


@pytest.mark.slow
def test_the_cost_is_what_one_takes_more_than_the_other() -> None:
    done: list[int] = []
    slow, quick = Spec(start=0.1, step=0.004), Spec(start=0.0, step=0.0)
    cost = isolation_cost(quick, slow, rounds=2, progress=done.append)
    assert cost.step_us >= 3000
    assert cost.episode_ms >= 80
    assert done == [1, 1]
    assert not cost.within_aim
    assert isolation_cost(slow, quick, rounds=1).step_us <= -3000


def test_both_costs_must_be_within_the_aim() -> None:
    assert IsolationCost(step_us=STEP_US, episode_ms=EPISODE_MS).within_aim
    assert not IsolationCost(step_us=STEP_US + 1, episode_ms=EPISODE_MS).within_aim
    assert not IsolationCost(step_us=STEP_US, episode_ms=EPISODE_MS + 1).within_aim


@pytest.fixture
def _no_sandbox_left() -> Iterator[None]:
    yield
    close_sandboxes()


@pytest.mark.slow
@pytest.mark.usefixtures("_no_sandbox_left")
def test_every_way_that_works_here_is_measured_and_costs_something() -> None:
    with isolated() as (plain, ways):
        assert plain.isolation == "none"
        assert list(ways) == list(working_levels())
        for name, policy in ways.items():
            assert policy.isolation == name
            cost = isolation_cost(plain, policy, rounds=1)
            assert cost.step_us > 0
            assert math.isfinite(cost.episode_ms)
