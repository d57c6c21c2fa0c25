"""The conformance checks: what is registered passes, and each rule is enforced."""

import dataclasses
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest
from colift.agents.humans import Smooth
from colift.agents.registry import SUITES, TASKS, entries, lookup
from colift.benchmark.episode.level import LEVEL, Level
from colift.benchmark.suites.suite import make_suite
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
    TwoNumbers: "policy TwoNumbers: .* must be 1 number",
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
        (Unmeasured, "lacks sparc"),
        (Unbounded, "robot_observation.. is .* outside its bounds"),
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
        (
            {"scenarios": (dataclasses.replace(first, subject=heavier),)},
            "does not rebuild it",
        ),
    ):
        with pytest.raises(AssertionError, match=rule):
            check_suite(dataclasses.replace(quick, **changes))


class Silent(Follow):
    def act(self, observation):
        pass


class Speaks(Follow):
    def act(self, observation):
        return "up"


class Raises(Follow):
    def act(self, observation):
        return observation.nothing


class Unmade(Follow):
    def __init__(self):
        raise ValueError("no weights")


class Actless:
    def reset(self, seed):
        pass


class Unpacks(Follow):
    def act(self, observation):
        *_, last, sixth = observation[4:]
        return last + sixth


@pytest.mark.parametrize(
    ("policy", "rule"),
    [
        (Silent, "policy Silent: the robot's action must be 1 number, got None"),
        (Speaks, "action must be 1 number, got 'up'"),
        (Raises, r"policy Raises raised AttributeError: .*test_testing.py:\d+"),
        (Unmade, "policy Unmade: its constructor raised ValueError: no weights"),
        (Actless, r"policy Actless has no method act\(\)"),
        (
            Unpacks,
            r"not enough values .*; if it plays another task, .*check_policy\(Policy, task\)",
        ),
        (Follow(), "a class, or a function that makes a policy, got an object of Follow"),
    ],
)
def test_a_policy_that_cannot_act_is_refused_in_words(policy, rule):
    with pytest.raises(AssertionError, match=rule):
        check_policy(policy)


class Undecorated(Smooth):
    """A dataclass by its parent alone."""

    share: float = 0.5


class Renamed(Smooth):
    """The plans of its parent."""

    kind: ClassVar[str] = "renamed"


def test_a_subclass_without_fields_needs_no_decorator():
    check_behaviour(Renamed())


def raising(plan, seed):
    raise RuntimeError("no idea")


def with_nan(plan, seed):
    target = plan.target.copy()
    target[7] = np.nan
    return dataclasses.replace(plan, target=target)


@pytest.mark.parametrize(
    ("behaviour", "rule"),
    [
        (Undecorated(), "Undecorated must itself be a frozen dataclass"),
        (Smooth, "must be an object, got the class Smooth"),
        (
            Altered(change=lambda plan, _: plan.target),
            r"Altered: plan\(\) of draw-0 with seed 0 returned an array; it must return .*\.Plan",
        ),
        (Altered(change=lambda plan, _: None), "returned None; it must"),
        (Altered(change=raising), r"raised RuntimeError: no idea \(.*test_testing.py:\d+\)"),
        (Altered(change=with_nan), "whose target is nan in frame 7"),
    ],
)
def test_a_behaviour_without_plans_is_refused_in_words(behaviour, rule):
    with pytest.raises(AssertionError, match=rule):
        check_behaviour(behaviour)


@dataclass(frozen=True)
class Unlike(Level):
    """A level task with one method changed."""

    method: str
    returned: object

    def _changed(self, method, value):
        return self.returned(value) if self.method == method else value

    def robot_observation(self, lift):
        return self._changed("robot_observation", super().robot_observation(lift))

    def partner_observation(self, lift):
        return self._changed("partner_observation", super().partner_observation(lift))

    def rewards(self, lift):
        return self._changed("rewards", super().rewards(lift))

    def failure(self, lift):
        return self._changed("failure", super().failure(lift))

    def score(self, lift, trace, *, failed):
        return self._changed("score", dict(super().score(lift, trace, failed=failed)))


def nan_first(view):
    return np.concatenate(([np.nan], view[1:]))


@pytest.mark.parametrize(
    ("method", "returned", "rule"),
    [
        (
            "robot_observation",
            lambda view: np.append(view, (0.0, 1.0)),
            r"robot_observation\(\) has 7 numbers, robot_bounds\(\) has 5",
        ),
        ("robot_observation", nan_first, r"robot_observation\(\) is nan at index 0"),
        ("robot_observation", list, r"robot_observation\(\) returned a list; it must be an array"),
        ("partner_observation", nan_first, r"partner_observation\(\) is nan at index 0"),
        ("rewards", sum, r"rewards\(\) returned -.*; it must return two finite numbers"),
        ("failure", lambda _: True, r"failure\(\) returned True; it must return a reason or None"),
        ("score", lambda scores: {**scores, "more": 1.0}, "has the surplus more;"),
        ("score", lambda scores: {**scores, "sparc": np.inf}, "returned sparc = inf; it must be"),
        ("score", lambda scores: {**scores, "rmse_mm": np.nan}, "rmse_mm = nan, but it is stated"),
        ("score", lambda scores: {**scores, "sparc": "good"}, "sparc as a str; it must be a float"),
        (
            "score",
            lambda scores: scores.nothing,
            r"score\(\) in smooth/S1, seed 0, raised Attribute",
        ),
    ],
)
def test_a_task_that_returns_something_else_is_refused_in_words(method, returned, rule):
    with pytest.raises(AssertionError, match=f"Unlike.*{rule}"):
        check_task(Unlike(method=method, returned=returned))


@dataclass(frozen=True)
class Fragile(Level):
    """A task without an error for a lift that fails at once."""

    def score(self, lift, trace, *, failed):
        scores = dict(super().score(lift, trace, failed=failed))
        return {**scores, "rmse_mm": np.nan} if failed else scores


class Inherits(Level):
    """A dataclass by its parent alone, with a state of its own."""

    def __init__(self):
        object.__setattr__(self, "memory", [])


@pytest.mark.parametrize(
    ("task", "rule"),
    [
        (Fragile(), "rmse_mm = nan"),
        (Inherits(), "Inherits must itself be a frozen dataclass"),
        (Level, "must be an object, got the class Level"),
    ],
)
def test_a_task_is_an_object_that_scores_failures(task, rule):
    with pytest.raises(AssertionError, match=rule):
        check_task(task)


@pytest.mark.parametrize("value", [[1], lambda: make_suite("quick-v1")])
def test_a_suite_is_an_object(value):
    with pytest.raises(AssertionError, match=r"check_suite takes a Suite, got a (list|function)"):
        check_suite(value)
