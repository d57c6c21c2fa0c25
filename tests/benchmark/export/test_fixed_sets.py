"""The fixed sets: people and seeds of training, prefixes of each other, made again to the bit."""

from contextlib import closing

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.base.registry import SUITES, own_entries
from colift.benchmark.environment.parallel import parallel_env
from colift.benchmark.export.fixed_sets import MOST_LIFTS, play_set, set_digest, set_plan
from colift.benchmark.export.rules import RULES
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.training.anticipation import FIRST_SEED, LAST_SEED

MOTION = "trial,t_s,z_m\n" + "".join(
    f"{name},{k / 50:.2f},{0.3 * min(k / up, (60 - k) / (60 - up)):.3f}\n"
    for name, up in (("a", 20), ("b", 30), ("c", 40))
    for k in range(61)
)


@pytest.fixture
def recordings(tmp_path):
    path = tmp_path / "people.csv"
    path.write_text(MOTION)
    return path


def test_people_and_seeds_are_those_for_training():
    taken = {seed for name in own_entries(SUITES) for seed in make_suite(name).seeds}
    plan = set_plan("follow", MOST_LIFTS)
    for lift in plan:
        assert FIRST_SEED <= lift.seed <= LAST_SEED
        assert lift.scenario.subject.name == f"draw-{lift.seed}"
        assert lift.seed not in taken
    assert {lift.scenario.behaviour for lift in plan[:4]} == set(BEHAVIOURS)


@pytest.mark.parametrize("name", RULES)
def test_a_smaller_set_is_the_beginning_of_a_larger_one(name, recordings):
    chosen = recordings if RULES[name].recorded else None
    small, large = (set_plan(name, n, recordings=chosen) for n in (30, 300))
    for one, other in zip(small, large, strict=False):
        assert (one.scenario, one.seed, one.kind) == (other.scenario, other.seed, other.kind)
    assert set_digest(small) != set_digest(large)
    assert set_digest(small) == set_digest(set_plan(name, 30, recordings=chosen))


@pytest.mark.parametrize("name", RULES)
def test_a_lift_is_the_same_to_the_bit_and_replays(name, recordings):
    chosen = recordings if RULES[name].recorded else None
    plan = set_plan(name, 6, both=True, recordings=chosen)
    lift, again = next(play_set(plan[5:])), next(play_set(plan[5:]))
    assert np.array_equal(lift.robot.observations, again.robot.observations)
    assert np.array_equal(lift.robot.actions, again.robot.actions)
    behaviour = f"recorded:{recordings}#{lift.trial}" if lift.trial else lift.behaviour
    partner = plan[5].scenario.partner
    with closing(parallel_env(behaviour, lift.subject, partner)) as env:
        env.reset(seed=0)
        env.lift.reset(lift.seed)
        for step in range(lift.steps):
            assert np.array_equal(env.lift.partner_observation(), lift.robot.observations[step])
            _, rewards, *_ = env.step(
                {"human": lift.human.actions[step], "robot": lift.robot.actions[step]}
            )
            assert rewards["robot"] == lift.robot.rewards[step]


def test_robots_of_the_follow_set_differ_and_are_in_bounds():
    lifts = list(play_set(set_plan("follow", 4)))
    gains = []
    for lift in lifts:
        assert np.abs(lift.robot.actions).max() <= 0.04 + 1e-15
        error = lift.robot.observations[:-1, 0] - lift.robot.observations[:-1, 2]
        gains.append(float(np.dot(error, lift.robot.actions[:, 0]) / np.dot(error, error)))
    assert max(gains) - min(gains) > 0.1


@pytest.mark.parametrize("name", ["mixed", "recorded"])
def test_each_behaviour_and_recording_meets_each_agent(name, recordings):
    plan = set_plan(name, 24, recordings=recordings if name == "recorded" else None)
    motions = {(lift.scenario.behaviour, lift.scenario.trial) for lift in plan}
    met = {(lift.scenario.behaviour, lift.scenario.trial, lift.kind) for lift in plan}
    assert len(met) == 2 * len(motions)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("nonesuch", 3), "unknown set 'nonesuch'; known: follow, human"),
        (("follow", 0), "--lifts must be from 1 to 10000, got 0"),
        (("recorded", 3), "needs the motion of real people: --recordings FILE.csv"),
    ],
)
def test_a_wrong_set_is_refused_by_name(arguments, told):
    with pytest.raises(InputError) as refused:
        set_plan(*arguments)
    assert told in str(refused.value)


def test_a_set_of_simulated_people_takes_no_recordings(recordings):
    with pytest.raises(InputError, match="takes no --recordings"):
        set_plan("follow", 3, recordings=recordings)
