"""The conformance check of behaviours: each rule is enforced, in words."""

import dataclasses
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest
from colift.agents.humans import Smooth
from colift.testing import check_behaviour


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
        (Altered(change=raising), r"raised RuntimeError: no idea \(.*test_behaviours.py:\d+\)"),
        (Altered(change=with_nan), "whose target is nan in frame 7"),
    ],
)
def test_a_behaviour_without_plans_is_refused_in_words(behaviour, rule):
    with pytest.raises(AssertionError, match=rule):
        check_behaviour(behaviour)
