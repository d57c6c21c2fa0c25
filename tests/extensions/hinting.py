"""A laboratory's task with people of its own: one module, and entry points.

The table should slope as the person's wrists hint, and the person insists while it does not.
"""

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans.following import FollowsPlan
from colift.agents.humans.person import Trait, drawn_traits
from colift.agents.senses import Sense
from colift.benchmark.episode.metric import Metric, metric_table
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.touch import Touch
from colift.benchmark.world.table import TABLE_LENGTH

ENTRY_POINTS = """\
[colift.tasks]
hint = hinting:Hint
[colift.suites]
hint-v1 = hinting:hint_suite
"""

STEEPEST = 0.08
"""Largest wanted height difference [m]."""

CHANGE = 80
"""Frames in which the wanted difference changes."""


class Manner(NamedTuple):
    """How a person hints."""

    wrist: float
    """Part of the wanted pitch that the wrists turn to."""
    insistence: float
    """Growth of that part per error and time [1/(m s)]."""


class Memory(NamedTuple):
    """What a person keeps."""

    more: float
    """Growth of the wrists' part."""


class Hinting(NamedTuple):
    """An intention, a number for each frame."""

    target: list
    difference: list
    part: list


class Hints(FollowsPlan):
    """Goes along the plan, and hints at the slope."""

    traits: ClassVar = {"wrist": Trait(0.3, 1.0), "insistence": Trait(0.0, 20.0, least=0.0)}
    shown: ClassVar = ("wrist",)
    intention: ClassVar = Hinting

    def draw(self, subject, seed, steps, size):
        """Return the person's manner."""
        return (), Manner(**drawn_traits(self.traits, subject, 0x417))

    def begin(self, f, zero, no):
        """Return a person who has not insisted yet."""
        return Memory(zero)

    def intend(self, f, drawn, memory, view, frames):
        """Insist while the seen slope is wrong; give it up while it is right."""
        seen = view.seen("robot_end", view.visual) - view.seen("human_end", view.visual)
        error = f.abs(seen - view.seen("difference", view.visual))
        grown = memory.more + drawn.manner.insistence * (error - 0.01) * frames * FRAME
        more = f.clip(grown, 0.0, 1.0)
        step = (more - memory.more) / frames
        return Memory(more), Hinting(
            drawn.target.next(view.frame, frames),
            drawn.series.slope.next(view.frame, frames),
            f.column([memory.more + step * (i + 1) for i in range(frames)]),
        )

    def drive(self, f, drawn, intention, reference):
        """Return the wanted difference, and the pitch of the wrists."""
        pitch = f.arcsin(intention.difference / TABLE_LENGTH)
        return intention.difference, drawn.manner.wrist * (1.0 + intention.part) * pitch


class Slopes(NamedTuple):
    """The task's series."""

    slope: np.ndarray
    """Wanted height of the far end above the near one [m]."""


@dataclass(frozen=True, kw_only=True)
class Hint(Touch):
    """Keep the table at the slope at which the person's wrists hint."""

    name = "hint"
    person = Hints()
    senses = (Sense("inclination", -1.0, 1.0, "sine of the pitch", 5e-4, scale=10.0, rate=50.0),)
    metrics = metric_table(
        (
            Metric(
                name="rmse_mm",
                symbol="RMSE",
                label="RMSE of the slope",
                unit="mm",
                missing="never",
                shown="board",
                meaning="root mean square error of the height difference",
            ),
        )
    )

    def setting(self, plan, frames, seed):
        """Return the wanted differences."""
        rng, slope, here = np.random.default_rng(seed("hint")), np.zeros(frames), 0.0
        for frame in range(plan.strokes[0][0] + 50, frames - 200, 200):
            there = float(rng.uniform(-STEEPEST, STEEPEST))
            t = np.minimum(np.arange(1, frames - frame + 1) / CHANGE, 1.0)
            slope[frame:] = here + (there - here) * t**3 * (10 - 15 * t + 6 * t**2)
            here = there
        return Slopes(slope), ()

    def observe(self, f, drawn, view):
        """Return the inclination of the table."""
        late = view.latency
        return ((view.seen("robot_end", late) - view.seen("human_end", late)) / TABLE_LENGTH,)

    def missed(self, f, due, ends):
        """Return the squared error of the height difference."""
        return ((ends.far - ends.near - due.slope) ** 2,)


def hint_suite():
    """4 lifts of two people."""
    scenarios = tuple(make_scenario("smooth", each, task="hint") for each in ("S1", "draw-3"))
    return Suite(name="hint-v1", scenarios=scenarios, seeds=(0, 1))
