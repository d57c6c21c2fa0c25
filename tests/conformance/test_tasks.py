"""The conformance check of tasks: what is registered passes, and each rule is enforced."""

from dataclasses import dataclass

import numpy as np
import pytest
from colift.base.registry import TASKS, entries, lookup
from colift.benchmark.tasks.level.task import LEVEL, Level
from colift.testing import check_task


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


@dataclass(frozen=True)
class Unlike(Level):
    """A level task with one method changed."""

    method: str
    returned: object

    def _changed(self, method, value):
        return self.returned(value) if self.method == method else value

    def robot_observation(self, lift):
        return self._changed("robot_observation", super().robot_observation(lift))

    def second_person_observation(self, lift):
        return self._changed("second_person_observation", super().second_person_observation(lift))

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
        (
            "second_person_observation",
            nan_first,
            r"second_person_observation\(\) is nan at index 0",
        ),
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
