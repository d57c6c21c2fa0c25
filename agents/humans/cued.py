"""Lifts by cues: goals that appear, and a person who chooses the movement to them."""

from dataclasses import dataclass
from typing import Final, Literal, NamedTuple, get_args

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans.movement import MovementDraw, interpolate
from colift.agents.humans.plan import Plan, Segment, assemble, still
from colift.agents.humans.stroke import replan
from colift.agents.humans.subject import GOAL_RANGE, Subject
from colift.base.errors import InputError

CueKind = Literal["smooth", "pause", "changing_goal"]
KINDS: Final[tuple[CueKind, ...]] = get_args(CueKind)

READY: Final = 0.8
"""Rest before the first cue [s], added to the drawn rest: a person needs a moment to grip."""

REACTION: Final = 0.30
"""Time from a cue to the planned movement [s]: a simple reaction to something seen takes 0.2 to
0.3 s, with a mouse a little longer."""

SETTLING: Final = 1.0
"""Time after each planned movement before the next cue [s]: people are slower with a pointer, and
differ from one another."""

PAUSE_AT: Final = (0.35, 0.65)
"""Range of the height of an intermediate stop, relative to the goal's."""

CHANGE_AT: Final = (0.3, 0.7)
"""Range of the time of a changed goal, relative to the movement's duration."""

CHANGE_TO: Final = (0.4, 1.4)
"""Range of a changed goal, relative to the first one, outside :data:`NEAR_GOAL`."""

NEAR_GOAL: Final = (0.8, 1.2)
"""A changed goal differs from the first by at least a fifth."""

LIVE_SUBJECT: Final = Subject(
    name="live",
    amplitude=0.20,
    duration=2.10,
    lowering_ratio=1.05,
    submovements=(0, 0),
    motor_noise=0.0,
    tremor_amplitude=0.0,
    tremor_frequency=9.0,
    visual_delay=0.160,
    haptic_delay=0.075,
    stiffness=300.0,
    damping=16.0,
    mass=1.2,
    pull=0.0,
)
"""The arm that a real person moves, at either end and the same for everybody: stiffness, damping
and mass of S2. It has no reflexes, no motor noise and no tremor: those are the person's own. The
delays have no effect without reflexes; height and duration are those of the cues."""


class Cue(NamedTuple):
    """A goal that appears."""

    frame: int
    """The frame at whose beginning it appears."""
    height: float
    """The goal [m]."""


@dataclass(frozen=True, kw_only=True)
class Cued:
    """Follows cues: a goal to lift to, and the rest height at the end.

    ``smooth`` has one goal, ``pause`` an intermediate stop before it, ``changing_goal`` another
    goal while the hand is on its way. Everything follows from the kind and the seed, so that real
    people, simulated ones and teams can play the same cues.

    Raises
    ------
    InputError
        If the kind is unknown.
    """

    kind: CueKind = "smooth"
    seed: int = 0
    """Seed of the cues, which replaces that of the episode."""

    def __post_init__(self) -> None:
        """Check the kind."""
        if self.kind not in KINDS:
            raise InputError(f"a cue must be one of {', '.join(KINDS)}, got {self.kind!r}")

    def cues(self) -> tuple[Cue, ...]:
        """Return the goals in order; the last is the height of rest."""
        return tuple(cue for cue, _ in self._drawn()[0])

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the movement that the cues ask for: minimum jerk, after a reaction time.

        A simulated person carries it out. A real person sees the cues, and moves in another way.
        """
        legs, end = self._drawn()
        segments = [still("ready", 0.0, legs[0][0].frame * FRAME + REACTION)]
        state = np.zeros(3)
        for (cue, duration), following in zip(legs, [*legs[1:], None], strict=True):
            stop = (end if following is None else following[0].frame) + round(REACTION / FRAME)
            start = cue.frame + round(REACTION / FRAME)
            motion = replan(state, cue.height, duration)
            moving = min(motion.shape[1], stop - start)
            name = "rise" if cue.height > float(state[0]) else "lower"
            segments.append(Segment(name, motion[0, :moving], True))
            if stop - start > moving:
                rest = Segment("hold", np.full(stop - start - moving, cue.height), False)
                segments.append(rest)
            state = motion[:, moving - 1]
        return assemble(*segments)

    def _drawn(self) -> tuple[list[tuple[Cue, float]], int]:
        """Return the cues with the durations of their movements [s], and the last frame."""
        rng = np.random.default_rng(self.seed)
        lift = MovementDraw.sample(LIVE_SUBJECT, rng)
        part, change, size, side = rng.random(4).tolist()
        goals: list[tuple[float, float | None]] = [(lift.height, None), (0.0, None)]
        if self.kind == "pause":
            goals.insert(0, (interpolate(PAUSE_AT, part) * lift.height, None))
        elif self.kind == "changing_goal":
            low, high = (CHANGE_TO[0], NEAR_GOAL[0]), (NEAR_GOAL[1], CHANGE_TO[1])
            other = lift.height * interpolate(low if side < 0.5 else high, size)
            goals[0] = (lift.height, interpolate(CHANGE_AT, change))
            goals.insert(1, (min(max(other, GOAL_RANGE[0]), GOAL_RANGE[1]), None))
        found = []
        time, height = READY + lift.before, 0.0
        for goal, cut in goals:
            duration = lift.duration(goal - height)
            found.append((Cue(round(time / FRAME), goal), duration))
            time += REACTION + (duration * cut if cut else duration + SETTLING)
            height = goal
        return found, round((time + lift.after - REACTION) / FRAME)
