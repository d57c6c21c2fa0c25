"""A lift whose goal changes on the way up."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans.movement import MovementDraw, interpolate, natural_stroke
from colift.agents.humans.plan import Plan, assemble, move, still
from colift.agents.humans.stroke import replan
from colift.agents.humans.subject import GOAL_RANGE, Subject

Change = Literal["reverse", "undershoot", "overshoot"]

SHORTEST = 0.6
"""Shortest re-planned movement [s]."""

LOWEST_TURN = 0.03
"""Turning back ends at least this high [m], so that a lowering remains."""


@dataclass(frozen=True, kw_only=True)
class ChangingGoal:
    """Changes the goal on the way up: turns back, or stops lower or higher than first intended."""

    changes: tuple[Change, ...] = ("reverse", "undershoot", "overshoot")
    """Possible changes, equally likely: turning back, a lower goal, a higher goal."""
    part: tuple[float, float] = (0.3, 0.7)
    """Earliest and latest change, relative to the duration of the upward stroke."""
    size: tuple[float, float] = (0.2, 0.6)
    """Smallest and largest change of the goal, relative to the first goal. Turning back descends by
    this much from the hand's height."""
    reaction: tuple[float, float] = (0.1, 0.2)
    """Shortest and longest time from the change to the new movement [s]."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``.

        An overshoot ends at the height drawn for the lift and first aims lower, for the same
        distribution of heights as in the other behaviours. Turning back happens only above the
        lowest goal of ``GOAL_RANGE``, and an undershoot does not go below it.
        """
        rng = np.random.default_rng(seed)
        lift = MovementDraw.sample(subject, rng)
        part, size, reaction = rng.random(3).tolist()
        change = self.changes[int(rng.integers(len(self.changes)))]
        size = interpolate(self.size, size)
        first = lift.height / (1.0 + size) if change == "overshoot" else lift.height

        up = natural_stroke(subject, first, lift.up, rng)
        switch = round(lift.up * interpolate(self.part, part) / FRAME)
        if change == "reverse":
            switch = max(switch, int(np.searchsorted(up[0], GOAL_RANGE[0])))
        turn = min(switch + round(interpolate(self.reaction, reaction) / FRAME), up.shape[1])
        state = up[:, turn - 1]
        here = float(state[0])
        goal = {
            "reverse": max(here - size * first, LOWEST_TURN),
            "undershoot": max((1.0 - size) * first, GOAL_RANGE[0]),
            "overshoot": lift.height,
        }[change]
        new = replan(state, goal, max(lift.duration(goal - here), SHORTEST))
        down = natural_stroke(subject, -goal, max(lift.duration(-goal), SHORTEST), rng)
        return assemble(
            still("ready", 0.0, lift.before),
            move("rise", up[0, :switch]),
            move(change, up[0, switch:turn]),
            move("replan", new[0]),
            still("hold", goal, lift.hold),
            move("lower", goal + down[0]),
            still("rest", 0.0, lift.after),
        )
