"""One world for many scenarios: the bits of a new one, and none is left over."""

import dataclasses
import pickle
from dataclasses import dataclass, field

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import EvaluatorFault
from colift.benchmark.episode import kept_world
from colift.benchmark.episode.kept_world import drop_kept_world, lift_in_kept_world
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.execution.playing import play
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.world.table import TABLE

COPY = PolicySpec(text="copy")


@pytest.fixture(autouse=True)
def _none_kept():
    yield
    drop_kept_world()


def bits(episode):
    """Return all that an episode is, without its times."""
    trace = {name: value for name, value in vars(episode.trace).items() if "time" not in name}
    return pickle.dumps((trace, episode.scores, episode.failure))


@pytest.mark.slow
@pytest.mark.parametrize("task", ["level", "ball"])
@pytest.mark.parametrize("partner", ["nao", "human"])
def test_each_lift_has_the_bits_of_a_world_of_its_own(partner, task):
    """Also after a lift of another person, and after another holder of the far end."""
    scenarios = [
        make_scenario("smooth", name, partner=partner, task=task) for name in ("S1", "S4", "S1")
    ]
    scenarios.insert(1, make_scenario("jerky", "S5", task=task))
    worlds = []
    for scenario in scenarios:
        for seed in (0, 3):
            found = next(play(COPY, scenario, (seed,)))
            worlds += [world for *_, world in kept_world._kept]
            with COPY.agent() as agent:
                assert bits(found) == bits(run_episode(Lift(scenario), agent, seed))
    assert len(worlds) == 8
    assert worlds[-1] is worlds[-4]  # One person has taken over from another.


def test_an_error_leaves_no_world():
    with pytest.raises(EvaluatorFault), lift_in_kept_world(make_scenario("smooth", "S1")):
        raise EvaluatorFault("the disk burns")
    assert kept_world._kept == []


def test_a_run_leaves_no_world():
    run_suite(COPY, make_suite("quick-v1"))
    assert kept_world._kept == []


@dataclass(frozen=True, kw_only=True)
class Stiffer(Level):
    """A task whose worlds change the person."""

    def world(self, human, far_end, table=TABLE, *, physics=None):
        human = dataclasses.replace(human, stiffness=2 * human.stiffness)
        return super().world(human, far_end, table, physics=physics)


@dataclass(frozen=True, kw_only=True)
class Weighted(Level):
    """A task with a parameter that cannot be compared as one."""

    weights: object = field(default_factory=lambda: np.ones(2))


@pytest.mark.parametrize("task", [Stiffer(), Weighted()])
def test_a_task_that_makes_its_worlds_itself_has_a_new_one_for_each_person(task):
    for name in ("S1", "S4"):
        scenario = dataclasses.replace(make_scenario("smooth", name), task=task)
        found = next(play(COPY, scenario, (0,)))
        assert kept_world._kept == []
        with COPY.agent() as agent:
            assert bits(found) == bits(run_episode(Lift(scenario), agent, 0))
