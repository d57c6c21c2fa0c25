"""robust-v1: what is drawn for each lift, the people, and that a robot is told nothing."""

import dataclasses
import hashlib
from contextlib import closing

import numpy as np
import pytest
from colift.agents.agent import RobotObservation
from colift.agents.humans import Subject
from colift.agents.humans.hand import CORRECTION_LIMIT
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.base.registry import suite_names
from colift.benchmark.bundle import Recipe
from colift.benchmark.episode.conditions import OLDEST, Conditions, read_conditions, sample_ages
from colift.benchmark.episode.kept_world import drop_kept_world
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.execution.playing import play
from colift.benchmark.links.link import Link
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.hidden import hidden_suite
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.robust.habits import HABITS, habits_of
from colift.benchmark.tasks.robust.suites import BEHAVIOURS, CONDITIONS
from colift.benchmark.tasks.robust.unseen import Unseen

COPY, HOLD = PolicySpec(text="copy"), PolicySpec(text="hold")

SUITE = make_suite("robust-v1")


@pytest.fixture(autouse=True)
def _none_kept():
    yield
    drop_kept_world()


def scenario(behaviour="wait", subject="draw-501", conditions=CONDITIONS):
    return dataclasses.replace(make_scenario(behaviour, subject), conditions=conditions)


def played(spec, scene, seed=0):
    with closing(Lift(scene)) as lift, spec.agent() as agent:
        return run_episode(lift, agent, seed)


def drawn(scene, seed=0):
    with closing(Lift(scene)) as lift:
        lift.reset(seed)
        return lift.conditions


def test_it_leads_every_list_of_suites():
    assert suite_names()[:2] == ("robust-v1", "standard-v1")


def test_it_has_each_of_many_people_once_in_every_behaviour():
    pairs = {(each.behaviour, each.subject.name) for each in SUITE.scenarios}
    people = {subject for _, subject in pairs}
    assert len(people) >= 25
    assert len(pairs) == len(SUITE.scenarios) == len(people) * len(BEHAVIOURS) == SUITE.size


def test_each_lift_has_conditions_of_its_own_within_the_ranges():
    found = [drawn(each) for each in SUITE.scenarios[:60]]
    for name in ("latency", "noise", "stiffness", "damping", "sag", "gain"):
        low, high = getattr(CONDITIONS, name)
        values = [getattr(each, name) for each in found]
        assert low <= min(values) < low + (high - low) / 4
        assert high - (high - low) / 3 < max(values) <= high
        assert len(set(values)) == len(values)
    masses = [each.table.mass for each in found]
    assert 0.2 <= min(masses) < 0.3 < 0.6 < max(masses) <= 0.7


def test_a_lift_is_the_same_whatever_was_played_in_its_world_before():
    scenes = (scenario(), scenario("dip", "draw-502"), scenario("smooth", "S1", None), scenario())
    alone = [played(COPY, each).trace.digest() for each in scenes]
    after_others = [next(play(COPY, each, (0,))).trace.digest() for each in scenes]
    assert alone == after_others
    assert alone[0] == alone[-1]


def test_a_hidden_suite_has_new_people_and_new_conditions():
    hidden = hidden_suite(SUITE, hashlib.sha256(b"any").digest())
    assert hidden.scenarios[0].conditions == CONDITIONS
    pairs = zip(SUITE.scenarios[:20], hidden.scenarios[:20], strict=True)
    for public, new in pairs:
        assert habits_of(public.subject) != habits_of(new.subject)
        before, after = drawn(public), drawn(new, hidden.seeds[0])
        assert before.latency != after.latency
        assert before.table != after.table


def test_conditions_are_in_the_digest_and_in_a_bundle():
    narrower = dataclasses.replace(CONDITIONS, latency=(0.0, 0.2))
    scenes = tuple(dataclasses.replace(each, conditions=narrower) for each in SUITE.scenarios)
    other = dataclasses.replace(SUITE, scenarios=scenes)
    assert other.digest != SUITE.digest
    recipe = Recipe.of(other)
    assert Recipe.parse(recipe.plain(), None).suite().digest == other.digest


def test_one_latency_for_all_lifts():
    timed = SUITE.with_timing(0.1, None)
    assert {drawn(each).latency for each in timed.scenarios[:10]} == {0.1}


@pytest.mark.parametrize(
    ("link", "steps"),
    [(Link(delay=0.17), 40), (Link(delay=0.1, jitter_mean=0.03, jitter_deviation=0.03), 400)],
)
def test_a_sample_is_as_old_as_its_delay_or_older(link, steps):
    ages = sample_ages(link, steps, 10, 5)
    assert len(ages) == steps + 1
    assert ages.min() >= round(100 * link.delay)
    if not link.jitter_mean:
        assert set(ages) == {17}
    else:
        # Of the ten samples of a period, the newest that has arrived is seen.
        assert 10 < ages.mean() < 13


def test_a_dropout_repeats_the_last_sample_with_its_error():
    conditions = Conditions(latency=(0.0, 0.0), loss=(0.5, 0.5), burst=(50.0, 50.0))
    with closing(Lift(scenario(conditions=conditions))) as lift:
        lift.reset(3)
        ages, views = lift.conditions.ages, []
        while not lift.done:
            views.append(lift.partner_observation())
            lift.step(lift.human().references(), [0.0])
    seen = np.array(views)[:, : RobotObservation.HAND_HEIGHT]
    older = np.flatnonzero((np.diff(ages) == 10)[: len(seen) - 1])
    assert len(older) > 5
    assert (seen[older + 1] == seen[older]).all()
    assert ages.max() <= OLDEST


def test_a_robot_is_told_nothing():
    with closing(Lift(scenario())) as lift:
        lift.reset(0)
        assert len(lift.partner_observation()) == len(RobotObservation)


def test_a_heavier_table_is_carried_by_both():
    for mass in (0.2, 0.7):
        scene = scenario("wait", conditions=Conditions(table=(mass, mass)))
        trace = played(HOLD, scene).trace
        both = trace.human_force[:20] + trace.robot_force[:20]
        assert both.mean() == pytest.approx(9.81 * mass, rel=1e-3)
        assert trace.human_end[:20] == pytest.approx(0.0, abs=1e-3)


def test_weak_arms_sag_and_slow_ones_lag():
    def robot_end(**ranges):
        return played(COPY, scenario("dip", conditions=Conditions(**ranges))).trace.robot_end

    usual = robot_end()
    slow = robot_end(gain=(0.5, 0.5))
    rising = np.gradient(usual) > 1e-3
    assert (slow - usual)[rising].mean() < -1e-3
    assert np.abs(robot_end(sag=(4.0, 4.0)) - usual).max() > 2e-3


def test_people_slow_down_for_a_robot_that_lags_and_no_more_than_they_must():
    plain = Conditions()
    with closing(Lift(scenario("follow", conditions=plain))) as lift:
        learned = run_episode(lift, PolicySpec(text="learned").make(), 0)
        in_time = lift.seen("time", 0)
        held = run_episode(lift, HOLD.make(), 0)
        stop, stuck = lift.plan.strokes[-1][1], lift.seen("time", 0)
        patience, horizon = habits_of(lift.scenario.subject).patience, lift.horizon
    assert in_time > stop > stuck
    # The person waits with the far end left behind, and the rest of the plan counts as missed.
    assert held.trace.human_end.max() < 2 * patience + CORRECTION_LIMIT + 0.005
    missing = stop - stuck
    assert held.scores["rmse_mm"] > 250 * (missing / (horizon + missing)) ** 0.5
    assert learned.scores["rmse_mm"] < 30


def test_nobody_slows_down_in_the_other_behaviours():
    for behaviour in ("wait", "stop"):
        with closing(Lift(scenario(behaviour))) as lift:
            run_episode(lift, HOLD.make(), 0)
            assert lift.intention._fields == ("target",)


def test_habits_are_the_person_s_and_within_the_population_s_ranges():
    people = [habits_of(Subject.draw(number)) for number in range(300)]
    for index, (name, trait) in enumerate(HABITS.items()):
        values = [each[index] for each in people]
        assert habits_of(Subject.draw(7))[index] == people[7][index]
        assert trait.low <= min(values) < max(values) <= trait.high, name
        assert np.mean(values) == pytest.approx((trait.low + trait.high) / 2, rel=0.1)


@pytest.mark.parametrize("behaviour", BEHAVIOURS)
def test_plans_are_smooth_stay_in_reach_and_end_where_they_began(behaviour):
    human = make_scenario(behaviour).human
    for seed in range(40):
        target = human.plan(Subject.draw(seed), seed).target
        assert target[0] == target[-1] == pytest.approx(0.0, abs=1e-9)
        assert target.min() > -0.028
        assert 0.08 < target.max() < 0.31
        assert np.abs(np.diff(target, 2)).max() < 1.5e-3
        assert len(target) < 2000


def test_people_who_dip_go_down_first_and_others_wait_long():
    for seed in range(20):
        subject = Subject.draw(seed)
        habits = habits_of(subject)
        dipping = make_scenario("dip").human.plan(subject, seed).target
        assert dipping.min() <= -0.69 * habits.dip
        waiting = make_scenario("wait").human.plan(subject, seed)
        assert waiting.strokes[0][0] >= 69 * habits.wait


def test_two_behaviours_are_for_tests_alone():
    unseen = {each.behaviour for each in SUITE.scenarios if isinstance(each.human, Unseen)}
    assert unseen == {"waltz", "double_pump"}


@pytest.mark.parametrize(
    ("ranges", "words"),
    [
        ({"latency": (0.3, 0.1)}, "range of latency must be"),
        ({"noise": (0.0, 1.0)}, "range of noise must be"),
        ({"loss": (0.0, 0.5), "burst": (1.0, 2.0), "table": (0.0, 1.0)}, "range of table must be"),
    ],
)
def test_ranges_that_cannot_be_are_refused(ranges, words):
    with pytest.raises(InputError, match=words):
        Conditions(**ranges)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"speed": [1.0, 2.0]}, "unknown key 'speed'"),
        ({"noise": [1.0]}, "noise must be two numbers"),
        ({"noise": [1, 2]}, "noise must be two numbers"),
        ({"noise": "loud"}, "noise must be two numbers"),
    ],
)
def test_conditions_of_a_bundle_are_checked(changes, words):
    with pytest.raises(InputError, match=words):
        read_conditions({**CONDITIONS.plain(), **changes}, "it")


def test_a_task_with_touch_has_no_conditions():
    with pytest.raises(InputError, match="without touch"):
        dataclasses.replace(make_scenario("together", task="intent"), conditions=CONDITIONS)
