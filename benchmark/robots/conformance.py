"""Conformance of a robot: it holds the table where it is told, always alike, and as it is drawn."""

import contextlib
import math
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.robots.model import load_model
from colift.benchmark.robots.robot import Robot, robot_fault
from colift.benchmark.world.bullet import pybullet
from colift.benchmark.world.bullet_world import BulletWorld
from colift.benchmark.world.human_body import BodyParameters
from colift.benchmark.world.interface import since_reset
from numpy.typing import NDArray

SAG: Final = 0.02
"""Largest distance of the table's end from the commanded height at rest [m]."""

SETTLED: Final = 3.0
"""Time after which the table rests [s]."""

STEP: Final = 10
"""Frames of a step."""


def robot_conformance_fault(robot: Robot, person: BodyParameters) -> str | None:
    """Return the first rule that a robot breaks, or None.

    It has all members of :class:`.Robot`; its stroke includes 0, its speed is positive; told to
    go to the middle of its stroke's upper half with a person at the near end, it holds the table
    there within ``SAG``; a reset brings back the same bits; and the joints of its postures are
    those of its model.
    """
    fault = robot_fault(robot) or _numbers_fault(robot)
    return fault or _holding_fault(robot, person) or _model_fault(robot)


def _numbers_fault(robot: Robot) -> str | None:
    low, high = robot.stroke
    if not -math.inf < low <= 0.0 < high < math.inf:
        return f"has the stroke {low} to {high} m; must include 0 and heights above it"
    if not 0.0 < robot.hand_speed < math.inf:
        return f"has the hand speed {robot.hand_speed} m/s; must be above 0"
    if not 0.0 <= robot.mass < math.inf:
        return f"has the mass {robot.mass} kg at the table's end; must be 0 or above"
    return None


def _holding_fault(robot: Robot, person: BodyParameters) -> str | None:
    height = robot.stroke[1] / 2
    frames = round(height / (robot.hand_speed / 2) / FRAME)
    rising = np.linspace(0.0, height, frames + 1)[1:].tolist()
    path = rising + [height] * (round(SETTLED / FRAME) + STEP - frames % STEP)
    with contextlib.closing(BulletWorld(person, robot)) as world:
        first = _held(world, path)
        world.reset()
        again = _held(world, path)
    if not np.isfinite(first).all():
        return "gives heights that are not finite"
    if abs(first[-1] - height) > SAG:
        return (
            f"holds the table at {first[-1]:.3f} m when told {height:.3f} m; must be within {SAG} m"
        )
    if not np.array_equal(first, again):
        return "does not repeat itself after a reset: Hands.reset() must forget the last lift"
    return None


def _held(world: BulletWorld, path: list[float]) -> NDArray[np.float64]:
    """Return the heights of the far end [m] while both ends are told to go the same way."""
    for begin in range(0, len(path), STEP):
        world.advance(path[begin : begin + STEP], path[begin : begin + STEP])
    return np.array(since_reset(world.robot_end))


def _model_fault(robot: Robot) -> str | None:
    client: int = pybullet.connect(pybullet.DIRECT)
    try:
        _, names = load_model(client, robot)
    except pybullet.error as error:
        return f"has a model that PyBullet does not load: {robot.model()}: {error}"
    finally:
        pybullet.disconnect(client)
    for height in robot.stroke:
        for name, angle in robot.posture(height).items():
            if name not in names:
                return f"has a posture with the joint {name!r}, which its model lacks"
            if not math.isfinite(angle):
                return f"has the angle {angle} of {name} for hands at {height} m"
    return None
