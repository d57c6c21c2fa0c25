"""A package whose tasks, suites and behaviours each break one rule."""

import dataclasses
from dataclasses import dataclass

import numpy as np
from colift.agents.humans import Smooth
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import Level

ENTRY_POINTS = """\
[colift.tasks]
wide = faulty:Wide
unscored = faulty:Unscored
endless = faulty:Endless
untrue = faulty:Untrue
short = faulty:Short
lost = faulty:Lost
renamed = faulty:Renamed
tall = faulty:Tall
made = faulty:made
[colift.suites]
many = faulty:many
empty = faulty:empty
confused = faulty:confused
other = faulty:other
absent = no_such_module:absent
own-people = faulty:own_people
[colift.humans]
flat = faulty:Flat
gap = faulty:Gap
stuck = faulty:Stuck
mute = faulty:Mute
deaf = faulty:Deaf
plain = faulty:Plain
"""


@dataclass(frozen=True)
class Wide(Level):
    """More numbers than bounds."""

    name = "wide"

    def robot_observation(self, lift):
        return np.append(lift.robot_view(), 0.0)


@dataclass(frozen=True)
class Unscored(Level):
    """A metric without a score."""

    name = "unscored"

    def score(self, lift, trace, *, failed):
        scores = dict(super().score(lift, trace, failed=failed))
        del scores["human_force_n"]
        return scores


@dataclass(frozen=True)
class Endless(Level):
    """An infinite score."""

    name = "endless"

    def score(self, lift, trace, *, failed):
        return {**super().score(lift, trace, failed=failed), "human_force_n": np.inf}


@dataclass(frozen=True)
class Untrue(Level):
    """A failure without a reason."""

    name = "untrue"

    def failure(self, lift):
        return lift.frame > 100


@dataclass(frozen=True)
class Short(Level):
    """A series that is too short."""

    name = "short"

    def series(self, lift):
        return {"gap": np.zeros(3)}


@dataclass(frozen=True)
class Lost(Level):
    """An error after some steps."""

    name = "lost"

    def failure(self, lift):
        return None if lift.frame < 100 else lift.nothing


@dataclass(frozen=True)
class Renamed(Level):
    """The name of its parent."""


@dataclass(frozen=True)
class Tall(Level):
    """A field without a default."""

    height: float
    name = "tall"


made = Wide()


def many():
    return [make_scenario("smooth")]


def empty():
    return Suite(name="empty", scenarios=(), seeds=(0,))


def confused():
    return make_scenario("smooth").nothing


def other():
    return Suite(name="another", scenarios=(make_scenario("smooth"),), seeds=(0,))


def own_people():
    """1 lift of a person who is not registered."""
    first = make_scenario("smooth")
    person = dataclasses.replace(first.subject, name="S1 light", mass=0.5)
    scenarios = (dataclasses.replace(first, subject=person),)
    return Suite(name="own-people", scenarios=scenarios, seeds=(0,))


@dataclass(frozen=True)
class Flat(Smooth):
    """Heights instead of a plan."""

    def plan(self, subject, seed):
        return super().plan(subject, seed).target


@dataclass(frozen=True)
class Gap(Smooth):
    """A height that is not a number."""

    def plan(self, subject, seed):
        plan = super().plan(subject, seed)
        target = plan.target.copy()
        target[150] = np.nan
        return dataclasses.replace(plan, target=target)


@dataclass(frozen=True)
class Stuck(Smooth):
    """An error for some people."""

    def plan(self, subject, seed):
        return super().plan(subject, seed).nothing


@dataclass(frozen=True)
class Mute:
    """No plan."""


@dataclass(frozen=True)
class Deaf(Smooth):
    """A plan of an earlier interface."""

    def plan(self, subject):
        return super().plan(subject, 0)


class Plain:
    """Not a dataclass."""

    def plan(self, subject, seed):
        return Smooth().plan(subject, seed)
