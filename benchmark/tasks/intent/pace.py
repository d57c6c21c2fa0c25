"""The pace at which a person goes through a plan, and the pose that the person intends there."""

from typing import Any, Final, Generic, NamedTuple

from colift.agents.agent import FRAME
from colift.agents.rules import ArrayFunctions, N, Series, at_time
from colift.benchmark.tasks.intent.manner import LeadingManner

CATCHING_UP: Final = 1.25
"""Fastest pace, for a person who is late; 1 is the plan's own."""


class PaceMemory(NamedTuple, Generic[N]):
    """What a person keeps from step to step; both 0 at the beginning."""

    time: N
    """Time within the plan, in frames."""
    past: N
    """Frames since the beginning."""


class PaceSenses(NamedTuple, Generic[N]):
    """What the pace depends on, one visual delay ago."""

    far: N
    """Height of the far end [m]."""
    planned: N
    """Its planned height at the person's time within the plan [m]."""


def pace(
    f: ArrayFunctions[N],
    manner: Any,
    memory: PaceMemory[N],
    senses: PaceSenses[N],
    frames: int,
) -> tuple[PaceMemory[N], list[N]]:
    """Return the memory after a step, and the time within the plan at the end of each frame of it.

    The person's manner must have the ``patience`` [m].

    A person who sees the far end at a distance e from its planned height goes through the plan at

        min(max(2 - e / patience, 0), 1)

    of its speed, and waits from twice the patience on. Afterwards the person catches up, at most at
    :data:`CATCHING_UP`.
    """
    away = f.abs(senses.far - senses.planned)
    rate = f.clip(2.0 - away / manner.patience, 0.0, 1.0)
    late = memory.past - memory.time
    hurried = f.minimum(rate * CATCHING_UP, rate + late / frames)
    rate = f.where(late > 0.0, hurried, rate)
    times = [memory.time + rate * (i + 1) for i in range(frames)]
    return PaceMemory(times[-1], memory.past + frames), times


class Pose(NamedTuple, Generic[N]):
    """A person's intention at the end of a frame."""

    near: N
    """Height of the person's end [m]."""
    far: N
    """Height of the far end [m]."""
    pitch: N
    """Pitch that the wrists turn towards [rad]."""


class PosePath(NamedTuple, Generic[N]):
    """A plan of both ends."""

    near: Series[N]
    """Height of the person's end [m]."""
    far: Series[N]
    """Height of the far end [m]."""


def intended(
    f: ArrayFunctions[N], manner: LeadingManner[N], plan: PosePath[N], time: N, length: float
) -> Pose[N]:
    """Return the intention at a time within a plan, in frames, on a table of a length [m]."""
    near, far = at_time(f, plan.near, time), at_time(f, plan.far, time)
    ahead = time + manner.lead / FRAME
    difference = at_time(f, plan.far, ahead) - at_time(f, plan.near, ahead)
    return Pose(near, far, manner.wrist * f.arcsin(difference / length))
