"""Tracebacks of policies in this process: complete below colift, and of the last episode."""

from pathlib import Path

import numpy as np
import pytest
from colift.agents.agent import Explaining, Printing
from colift.agents.traced import traced


class Failing:
    """A policy that fails in a function of its own."""

    def reset(self, seed):
        if seed < 0:
            raise SystemExit(seed)

    def act(self, observation):
        return self.deeper(observation)

    def deeper(self, observation):
        raise KeyError(len(observation))


class Telling(Failing):
    """The same with an explanation."""

    def internals(self):
        return {"confidence": 1.0}


@pytest.fixture
def folder(monkeypatch):
    """Work in the folder of this file."""
    monkeypatch.chdir(Path(__file__).parent)


def test_the_output_is_the_traceback_below_colift(folder):
    agent = traced(Failing())
    assert isinstance(agent, Printing)
    with pytest.raises(KeyError):
        agent.act(np.zeros(5))
    head, *frames, end = agent.printed.splitlines()
    assert (head, end) == ("Traceback (most recent call last):", "KeyError: 5")
    places = [line.split(", ") for line in frames if "File" in line]
    assert [(file, name) for file, _, name in places] == [
        (f'  File "{Path(__file__).name}"', "in act"),
        (f'  File "{Path(__file__).name}"', "in deeper"),
    ]


def test_the_next_reset_forgets_it():
    agent = traced(Failing())
    with pytest.raises(SystemExit):
        agent.reset(-1)
    assert agent.printed.endswith("SystemExit: -1\n")
    agent.reset(1)
    assert agent.printed == ""


def test_an_agent_that_keeps_its_output_is_left_alone():
    class Noting(Failing):
        printed = "a note"

    agent = Noting()
    assert traced(agent) is agent


def test_an_explanation_is_passed_on():
    assert not isinstance(traced(Failing()), Explaining)
    told = traced(Telling())
    assert isinstance(told, Explaining)
    assert told.internals() == {"confidence": 1.0}
