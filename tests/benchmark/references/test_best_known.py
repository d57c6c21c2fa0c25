import dataclasses
import pickle
from typing import ClassVar

import numpy as np
import pytest
from colift.agents.control.recurrent import shipped_network
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.comparison.playing import play_policies
from colift.benchmark.references.best_known import BestKnown, best_known_run, level_network
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.results.baselines import BEST_KNOWN
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks import rehearsal
from colift.benchmark.tasks.level.task import Level

pytestmark = pytest.mark.slow


def test_the_best_known_is_an_agent_of_its_own_weights():
    spec = BestKnown()
    with spec.agent() as agent:
        agent.reset(0)
        action = agent.act(np.array([0.01, 0.0, 0.0, 0.0, 0.0]))
    assert 0.0 < action[0] < 0.05
    assert spec.name == BEST_KNOWN
    assert spec.digest() == pickle.loads(pickle.dumps(spec)).digest()
    assert level_network().units >= shipped_network().units


def test_the_references_stand_in_the_right_order():
    """The oracle knows most, then the best known policy; both are kept apart from the policies."""
    scenarios = tuple(
        make_scenario(name, subject)
        for name in ("smooth", "pause", "jerky", "changing_goal")
        for subject in ("draw-200002", "draw-200003")
    )
    suite = Suite(name="few", scenarios=scenarios, seeds=(200_000, 200_001, 200_002))
    specs = {name: PolicySpec(text=name) for name in ("anticipate", "learned")}
    paired = play_policies(specs, suite, references=suite_references(suite))
    assert [policy.name for policy in paired.policies] == list(specs)
    errors = [found.scores.mean for found in paired.policies]
    reference = paired.references[BEST_KNOWN]
    assert 10 * paired.references["oracle"].mean < reference.mean < min(errors)


@pytest.mark.parametrize(
    ("behaviours", "policy", "most"),
    [
        (("pivot", "counter"), "pose_learned", 1.0),
        (("behind",), "agree_learned", 1.02),
        (("ball_smooth",), "ball_learned", 1.0),
    ],
)
def test_each_task_with_touch_has_a_reference_that_no_policy_of_its_passes(
    behaviours, policy, most, monkeypatch
):
    """The oracle of two hurdles tries a quarter of its bumps, which is less than it can.

    ``agree_learned`` is a network like its reference: on all lifts of the suite they are equal.
    ``ball_learned`` and ``pose_learned`` are their references.
    """
    monkeypatch.setattr(rehearsal, "BUMP_SPACING", 4 * rehearsal.BUMP_SPACING)
    task = policy.partition("_")[0].replace("pose", "intent")
    scenarios = tuple(make_scenario(each, "draw-200003", task=task) for each in behaviours)
    suite = Suite(name="few", scenarios=scenarios, seeds=(200_000,))
    paired = play_policies(
        {policy: PolicySpec(text=policy)}, suite, references=suite_references(suite)
    )
    reference, error = paired.references[BEST_KNOWN].mean, paired.policies[0].scores.mean
    assert paired.references["oracle"].mean < reference <= most * error


def test_a_suite_of_another_timing_has_the_oracle_alone():
    suite = Suite(name="one", scenarios=(make_scenario("smooth"),), seeds=(0,))
    assert list(suite_references(suite)) == [BEST_KNOWN, "oracle"]
    assert list(suite_references(suite.with_timing(0.2, None))) == ["oracle"]
    assert list(suite_references(suite.with_timing(None, 0.05))) == ["oracle"]
    for behaviour in ("recorded", "played"):
        first = dataclasses.replace(suite.scenarios[0], behaviour=behaviour, trial="a")
        real = dataclasses.replace(suite, scenarios=(first,))
        assert list(suite_references(real)) == ["oracle"]


def test_a_task_without_a_reference_is_named():
    @dataclasses.dataclass(frozen=True, kw_only=True)
    class Other(Level):
        name: ClassVar[str] = "other"

    scenario = dataclasses.replace(make_scenario("smooth"), task=Other())
    suite = Suite(name="one", scenarios=(scenario,), seeds=(0,))
    assert suite_references(suite) == {}
    with pytest.raises(InputError, match="no best_known was learned for the task 'other'"):
        best_known_run(suite)
