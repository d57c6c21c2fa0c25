"""The admission of sessions, with the shipped networks instead of trained ones."""

import dataclasses

import numpy as np
import pytest
from colift.agents.sessions.acquainted import shipped_network
from colift.base.registry import remembering
from colift.benchmark.admission.criteria import ADAPTATION
from colift.benchmark.admission.remembering import MEMORY, lifts_to_play, memory_of
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.session.telling import TOLD


def deaf(weights):
    """Return weights that are told the habits, and heed nothing of it."""
    return np.hstack((weights, np.zeros((len(weights), TOLD))))


@pytest.mark.slow
def test_each_criterion_of_four_people():
    whole = make_suite("session-v1")
    suite = dataclasses.replace(whole, name="four", scenarios=whole.scenarios[:4])
    forget = shipped_network(remember=False)
    networks = {
        "remember": shipped_network(remember=True),
        "forget": forget,
        "told": forget._replace(inputs=deaf(forget.inputs), output=deaf(forget.output)),
    }
    played = []
    found = memory_of(suite, networks, progress=played.append)
    assert sum(played) == lifts_to_play(suite)
    assert found.means["told"] == pytest.approx(found.means["forget"], rel=1e-3)
    pays, own, two_people, no_habits, differ = found.criteria
    assert pays.figure < 0.9 < no_habits.figure
    assert own.figure < 0.9
    assert two_people.figure < 1.0
    assert (differ.letter, differ.claim) == ("e", ADAPTATION)
    assert f"of {len(remembering())} policies and 4 people" in differ.detail
    assert list(found.claims) == [MEMORY, ADAPTATION]
    assert found.passed is all(each.verdict == "passed" for each in found.criteria[:4])
