"""The conformance checks: what is registered passes, and each rule is enforced."""

import dataclasses
from dataclasses import dataclass

import numpy as np
import pytest
from colift.agents.errors import InputError
from colift.agents.humans import Smooth
from colift.agents.registry import SUITES, TASKS, entries, lookup
from colift.benchmark.episode.level import LEVEL, Level
from colift.benchmark.suites.suite import Suite, make_suite
from colift.testing import check_behaviour, check_policy, check_suite, check_task


class Follow:
    """Follows the table; each bad policy changes one thing of it."""

    def reset(self, seed):
        self.steps = 0

    def act(self, observation):
        self.steps += 1
        return np.array([0.3 * (observation[0] - observation[3])])


class Writes(Follow):
    def act(self, observation):
        action = super().act(observation)
        observation[0] = 0.0
        return action


class Remembers(Follow):
    total = 0.0

    def reset(self, seed):
        pass

    def act(self, observation):
        self.total += observation[0]
        return np.array([self.total])


class Shares(Follow):
    heights = np.zeros(1)

    def reset(self, seed):
        self.heights[:] = 0.0

    def act(self, observation):
        self.heights[0] += observation[0]
        return self.heights.copy()


class TwoNumbers(Follow):
    def act(self, observation):
        return np.zeros(2)


class Infinite(Follow):
    def act(self, observation):
        return np.array([np.inf])


class Reuses(Follow):
    def __init__(self):
        self.action = np.zeros(1)

    def act(self, observation):
        self.action[0] = observation[0]
        return self.action


class Mumbles(Follow):
    def internals(self):
        return {f"at {self.steps}": 1.0}


class Overconfident(Follow):
    def internals(self):
        return {"confidence": 2.0}


BAD_POLICIES = {
    Writes: "leave the observation unchanged",
    Remembers: "reset must clear",
    Shares: "must not share state",
    TwoNumbers: "must be one number",
    Infinite: "must be finite",
    Reuses: "must not change after",
    Mumbles: "the same names",
    Overconfident: r"confidence must be in \[0, 1\]",
}


def test_a_plain_policy_conforms():
    check_policy(Follow)


@pytest.mark.parametrize(("policy", "rule"), BAD_POLICIES.items(), ids=lambda x: str(x)[:40])
def test_a_policy_that_breaks_a_rule_is_refused(policy, rule):
    with pytest.raises(AssertionError, match=rule):
        check_policy(policy)


@dataclass(frozen=True, kw_only=True)
class Altered(Smooth):
    """Smooth plans, changed."""

    change: object

    def plan(self, subject, seed):
        return self.change(super().plan(subject, seed), seed)


def stepped(plan, seed):
    target = plan.target.copy()
    target[300:] += 0.01
    return dataclasses.replace(plan, target=target, goal=float(target.max()))


CHANCE = np.random.default_rng(1)


def drawn_anew(plan, seed):
    target = plan.target * (1.0 - 1e-6 * CHANCE.random())
    target.flags.writeable = False
    return dataclasses.replace(plan, target=target, goal=float(target.max()))


BAD_PLANS = {
    "a step": (stepped, "begin and end at height 0|step of"),
    "a wrong goal": (lambda plan, _: dataclasses.replace(plan, goal=0.2), "must be the highest"),
    "no stroke": (lambda plan, _: dataclasses.replace(plan, strokes=()), "must be a stroke"),
    "a late stroke": (
        lambda plan, _: dataclasses.replace(plan, strokes=((0, 1),)),
        "outside its strokes",
    ),
    "writable": (
        lambda plan, _: dataclasses.replace(plan, target=plan.target.copy()),
        "read-only",
    ),
    "chance": (drawn_anew, "seed alone"),
    "one plan": (lambda plan, _, kept=[]: (kept.append(plan), kept[0])[1], "seed alone|differ"),
}


@pytest.mark.parametrize("name", BAD_PLANS)
def test_a_behaviour_that_breaks_a_rule_is_refused(name):
    change, rule = BAD_PLANS[name]
    with pytest.raises(AssertionError, match=rule):
        check_behaviour(Altered(change=change))


@pytest.mark.parametrize("name", entries(TASKS))
def test_every_task_conforms(name):
    check_task(lookup(TASKS, name)())


@dataclass(frozen=True)
class Unmeasured(Level):
    """A task that forgets a score."""

    def score(self, lift, trace, *, failed):
        scores = dict(super().score(lift, trace, failed=failed))
        del scores["sparc"]
        return scores


@dataclass(frozen=True)
class Unbounded(Level):
    """A task whose observations leave their bounds."""

    def robot_bounds(self):
        low, high = super().robot_bounds()
        return low, 0.01 * high


@dataclass(frozen=True)
class Short(Level):
    """A task that adds a series of the wrong length."""

    def series(self, lift):
        return {"slope": np.zeros(3)}


class NoDataclass:
    name, metrics = "bare", LEVEL.metrics


@pytest.mark.parametrize(
    ("task", "rule"),
    [
        (NoDataclass, "frozen dataclass"),
        (Unmeasured, "scores must be"),
        (Unbounded, "outside its bounds"),
        (Short, "one number per frame"),
    ],
)
def test_a_task_that_breaks_a_rule_is_refused(task, rule):
    with pytest.raises(AssertionError, match=rule):
        check_task(task())


@pytest.mark.parametrize("name", entries(SUITES))
def test_every_suite_conforms(name):
    check_suite(make_suite(name))


def test_a_suite_that_breaks_a_rule_is_refused():
    quick = make_suite("quick-v1")
    first = quick.scenarios[0]
    heavier = dataclasses.replace(first.subject, mass=1.4)
    for changes, rule in (
        ({"name": "quick\n"}, "ASCII"),
        ({"scenarios": (first, first)}, "distinct names"),
        ({"seeds": (1, 1)}, "seeds must be distinct"),
        ({"seeds": (-1,)}, "must not be negative"),
        (
            {"scenarios": (dataclasses.replace(first, subject=heavier),)},
            "does not rebuild it",
        ),
    ):
        with pytest.raises(AssertionError, match=rule):
            check_suite(dataclasses.replace(quick, **changes))


def test_a_suite_has_one_task():
    first, second, *_ = make_suite("quick-v1").scenarios
    mixed = (first, dataclasses.replace(second, task=Unmeasured()))
    with pytest.raises(InputError, match="suite 'mixed' must have one task, got 2"):
        Suite(name="mixed", scenarios=mixed, seeds=(0,))
