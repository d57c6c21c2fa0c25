"""Two processes that take turns share a processor, and are not held to it for long."""

import os

import pytest
from colift.agents.sandbox.host.agent import TURNS, Caller, allowed


@pytest.fixture
def caller():
    caller = Caller()
    yield caller
    caller.free()


def test_a_turn_is_held_to_the_processor_it_is_told_to_be_on(caller):
    here = caller.begin()
    assert os.sched_getaffinity(0) == {here}
    caller.free()
    assert os.sched_getaffinity(0) == allowed()


def test_every_few_turns_the_thread_is_free(caller):
    free = []
    for _ in range(3 * TURNS):
        caller.begin()
        caller.end()
        free.append(os.sched_getaffinity(0) == allowed())
    assert free == 3 * ([False] * (TURNS - 1) + [True]) or len(allowed()) == 1


def test_a_second_caller_in_a_held_thread_does_not_hold_it_for_good(caller):
    caller.begin()
    other = Caller()
    other.begin()
    caller.free()
    other.free()
    assert os.sched_getaffinity(0) == allowed()
