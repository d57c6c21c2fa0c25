"""Silly policies do not beat those who lift well, or carry the mark of the rough.

The policies are those of :mod:`.silly`, which name what they must not beat. All lift with the same
drawn people, of no suite.
"""

import functools

import pytest
from colift.agents.loading.policy_spec import InMemorySpec, PolicySpec
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import human_human_run
from colift.benchmark.results.roughness import rougher
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.catalogue import make_scenario, make_task
from colift.benchmark.suites.suite import Suite

from . import silly

pytestmark = pytest.mark.slow

PEOPLE = range(310_000, 310_004)

POLICIES = (
    silly.Tremble,
    silly.DeadZone,
    silly.Drag,
    silly.Brake,
    silly.GiveUp,
    silly.HoldUntilStill,
    silly.Drift,
    silly.HighGain,
    silly.OverCorrect,
    silly.FarLead,
    silly.StallTop,
    silly.Sweep,
    silly.SweepHalf,
    silly.Sweep24,
)


def lifts(task):
    """Return a lift of each person with each behaviour of a task."""
    scenarios = tuple(
        make_scenario(behaviour, f"draw-{person}", task=task)
        for person in PEOPLE
        for behaviour in make_task(task).behaviours
    )
    return Suite(name=f"silly-{task}", scenarios=scenarios, seeds=(0,))


@functools.cache
def scores(task, name):
    """Return the scores of two people, or of a registered policy."""
    suite = lifts(task)
    if name == silly.TWO_PEOPLE:
        return ScoreTable.of(human_human_run(suite))
    return ScoreTable.of(run_suite(PolicySpec(text=name), suite))


@pytest.mark.parametrize("policy", POLICIES, ids=lambda each: each.__name__)
def test_a_silly_policy_does_not_beat_who_lifts_well(policy):
    suite = lifts(policy.task)
    spec = InMemorySpec(name=policy.__name__, factory=policy, source=policy)
    mine = ScoreTable.of(run_suite(spec, suite))
    for name in policy.behind:
        assert mine.mean > scores(policy.task, name).mean, name
    people = scores(policy.task, silly.TWO_PEOPLE)
    assert rougher(mine, people, suite.metrics) or not policy.marked


@pytest.mark.parametrize("name", ["extrapolate", "anticipate", "learned"])
def test_who_lifts_well_carries_no_mark(name):
    suite = lifts("level")
    assert rougher(scores("level", name), scores("level", silly.TWO_PEOPLE), suite.metrics) == ()
