"""Policies that remember a person: what they gain, and that they forget the person before."""

import dataclasses

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.sessions.refined import Refined
from colift.agents.sessions.refitting import RefittingParameters
from colift.base.errors import InputError
from colift.base.registry import POLICIES, REMEMBERING, entries
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite

NAMES = [name for name, each in entries(POLICIES).items() if each.group == REMEMBERING]
WHOLE = make_suite("session-v1")
SUITE = dataclasses.replace(WHOLE, name="six", scenarios=WHOLE.scenarios[::7])


def played(text, suite):
    run = run_suite(PolicySpec(text=text), suite)
    assert all(each.failure is None for each in run.episodes)
    return run


def errors(run):
    return np.reshape([each.scores["rmse_mm"] for each in run.episodes], (-1, 10))


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_memory_makes_the_last_lifts_better(name):
    mine, without = (errors(played(text, SUITE)) for text in (name, f"{name},remember=false"))
    gained = np.log(mine[:, -3:] / without[:, -3:]).mean()
    assert gained < np.log(0.97)
    assert mine[:, -3:].mean() < mine[:, 0].mean()


@pytest.mark.parametrize("name", [name for name in NAMES if name != "acquainted"])
def test_the_first_lift_is_the_same_without_memory(name):
    """``acquainted`` has other weights for that."""
    first = dataclasses.replace(SUITE, scenarios=SUITE.scenarios[:1], seeds=(0,))
    mine, without = (played(text, first) for text in (name, f"{name},remember=false"))
    assert mine.episodes[0].trace.digest() == without.episodes[0].trace.digest()


def test_without_doubt_nothing_is_learned():
    certain = Refined(parameters=RefittingParameters(doubt=0.0))
    few = dataclasses.replace(SUITE, scenarios=SUITE.scenarios[:1], seeds=(0, 1))
    one = run_suite(PolicySpec(text="refined,doubt=0"), few)
    other = run_suite(PolicySpec(text="acquainted,remember=false"), few)
    for mine, theirs in zip(one.episodes, other.episodes, strict=True):
        assert mine.trace.digest() == theirs.trace.digest()
    assert not certain.internals()
    with pytest.raises(InputError, match="doubt must be a number of at least 0, got -1"):
        RefittingParameters(doubt=-1.0)
