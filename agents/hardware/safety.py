"""The limits of the hands, enforced below the policy: pure functions.

Whatever a policy returns, what reaches the robot has passed :func:`limited`.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
from colift.agents.actions import HAND_SPEED
from colift.agents.hardware.conduct import LARGEST_TILT
from colift.agents.hardware.ports import ArmState, HandLimits
from colift.base.errors import InputError
from colift.robots.nao.kinematics import ARM_JOINTS, STROKE, arm_path

JOINT_MARGIN: Final = 0.01
"""Distance that a joint keeps from the robot's own limit [rad]."""

TRACKING_ERROR: Final = 0.05
"""Distance between hand and set-point [m] from which the hand counts as not following.

The arms sag by some 4 mm and follow 20 to 50 ms late, 20 mm at the greatest speed."""

LOWEST_STIFFNESS: Final = 0.3
"""Stiffness below which a motor counts as switched off."""

ASTRAY: Final = 0.02
"""Distance of a joint's set-point from the path of this client's commands [rad] beyond which
another client is assumed to command it. Otherwise it is 0, up to the rounding of 32-bit floats;
0.02 rad are 3 mm at the hand."""


def limited(wanted: float, present: float, duration: float, limits: HandLimits) -> float:
    """Return the height to command [m], or the present one if the wanted is not a number.

        h = clip(clip(wanted, low, high), present - speed T, present + speed T)

    Parameters
    ----------
    wanted
        Any float, also NaN or infinite.
    present
        Height of the command so far [m], finite.
    duration
        Time T of the movement [s].
    limits
        Range of heights, and speed; from outside the range, the hands return at that speed.
    """
    if not math.isfinite(wanted):
        wanted = present
    reach = limits.speed * duration
    low, high = limits.low, limits.high
    wanted = min(max(wanted, low), high)
    return min(max(wanted, present - reach), present + reach)


def next_command(
    wanted: float, command: float, set_point: float, duration: float, limits: HandLimits
) -> float:
    """Return the height to command [m]: within reach of the last command and of the set-point.

    The robot's set-point lags behind the command by one or two cycles. Without the second limit, it
    would catch up faster than the limit of the speed.

    Parameters
    ----------
    wanted
        Any float.
    command
        The last command [m].
    set_point
        Present height of the robot's own set-points [m].
    duration, limits
        As for :func:`limited`.
    """
    height = limited(wanted, command, duration, limits)
    return limited(height, set_point, duration, limits)


def hand_limits(joint_limits: Mapping[str, Sequence[float]]) -> HandLimits:
    """Return the limits of the hands that follow from the robot's joint limits.

    Parameters
    ----------
    joint_limits
        Lowest and highest angle of each arm joint [rad].

    Raises
    ------
    InputError
        If a joint is missing, or the table's rest height is out of the robot's reach.
    """
    missing = sorted(set(ARM_JOINTS) - set(joint_limits))
    if missing:
        raise InputError(f"the robot states no limits of {', '.join(missing)}: is it a NAO H25?")
    lower, upper = np.array([joint_limits[name][:2] for name in ARM_JOINTS]).T
    path = arm_path()
    angles = np.array(path.joints)
    inside = (angles >= lower + JOINT_MARGIN) & (angles <= upper - JOINT_MARGIN)
    usable = inside.all(axis=1)
    rest = path.row(0.0)
    if not usable[rest]:
        name = ARM_JOINTS[int(np.argmin(inside[rest]))]
        raise InputError(
            f"the rest posture is out of the robot's reach: {name} must be at "
            f"{angles[rest][ARM_JOINTS.index(name)]:.3f} rad, its limits are "
            f"{joint_limits[name][0]:.3f} to {joint_limits[name][1]:.3f} rad"
        )
    outside = np.flatnonzero(~usable)
    first = int(outside[outside < rest].max(initial=-1)) + 1
    last = int(outside[outside > rest].min(initial=len(angles))) - 1
    return HandLimits(
        low=max(float(path.heights[first]), STROKE[0]),
        high=min(float(path.heights[last]), STROKE[1]),
        speed=HAND_SPEED,
        tilt=LARGEST_TILT,
    )


def motor_fault(state: ArmState) -> str | None:
    """Return the fault of the hands, or None if they follow their commands."""
    if not state.stiffness >= LOWEST_STIFFNESS:
        return f"an arm motor has the stiffness {state.stiffness:.2f}"
    if state.late and not state.astray <= ASTRAY:
        return (
            f"a joint has a set-point that is {state.astray:.3f} rad off the path of the last "
            "commands, on that of earlier ones: they are carried out late; the robot, the network "
            "or this machine is too busy"
        )
    if not state.astray <= ASTRAY:
        return (
            f"a joint has a set-point that is {state.astray:.3f} rad off the path of the commands "
            "given here: something else commands the robot"
        )
    if not abs(state.height - state.set_point) <= TRACKING_ERROR:
        return f"the hands are at {state.height:.3f} m, commanded to {state.set_point:.3f} m"
    return None
