"""The set-up before the first trial: offsets, rest heights, and a small test move.

Every function raises :class:`.StopTrialError` if the operator stops or a connection is lost, and
:class:`.InputError` if the set-up is wrong; the message says what to do.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from colift.agents.hardware.frames import drained
from colift.agents.hardware.plausibility import in_order, seen
from colift.agents.hardware.ports import ArmState, Clock, MotionCapture, RobotArm
from colift.agents.hardware.safety import ASTRAY, motor_fault
from colift.agents.hardware.stops import Stop, StopTrialError, losses_stop
from colift.agents.real_time import LOWEST_RATE
from colift.base.errors import InputError
from numpy.typing import NDArray

REST_TIME: Final = 1.0
"""Duration of a measurement of the rest heights [s]."""

STILL: Final = 0.003
"""Largest standard deviation of an end at rest [m]."""

PATIENCE: Final = 10
"""Number of measurements of the rest heights after which an end counts as moving."""

LARGEST_OFFSET: Final = 0.03
"""Largest sag of the hands under the table's weight that is compensated [m]."""

TEST_MOVE: Final = 0.02
"""Height of the test move [m]."""

PERIOD: Final = 0.1
"""Time between two commands of the set-up [s]."""

CALM_SPEED: Final = 0.05
"""Speed of the hands in the set-up [m/s]."""


@dataclass(frozen=True, kw_only=True)
class Rest:
    """The table at rest, before it is taken as zero."""

    human_end: float
    """Mean height of the human's end [m]."""
    robot_end: float
    """Mean height of the robot's end [m]."""
    noise: float
    """Standard deviation of a height from frame to frame [m]."""
    rate: float
    """Motion-capture frames per second."""


class Direction(NamedTuple):
    """Movement of the ends relative to that of the hands [m per m]."""

    human_end: float
    robot_end: float


def wait(clock: Clock, seconds: float) -> None:
    """Wait, unless the operator stops."""
    pressed = clock.wait_until(clock.now() + seconds)
    if pressed is not None:
        raise StopTrialError(Stop.OPERATOR, f"stopped by the operator: {pressed}")


def arm_state(robot: RobotArm) -> ArmState:
    """Return the state of the hands, unless another client moves them."""
    with losses_stop():
        state = robot.state()
    if not state.astray <= ASTRAY:
        raise StopTrialError(Stop.MOTORS, motor_fault(state) or "")
    return state


def measure_rest(capture: MotionCapture, clock: Clock, seconds: float = REST_TIME) -> Rest:
    """Measure the table at rest; wait for the person to hold still."""
    for _ in range(PATIENCE):
        ends, rate = _ends(capture, clock, seconds)
        spread = ends.std(axis=0)
        if spread.max() <= STILL:
            # Differences of neighbours, so that a slow sway of the hands does not count.
            noise = float(np.diff(ends, axis=0).std() / math.sqrt(2))
            human_end, robot_end = ends.mean(axis=0).tolist()
            return Rest(human_end=human_end, robot_end=robot_end, noise=noise, rate=rate)
    name = ("human's", "robot's")[int(spread.argmax())]
    raise InputError(
        f"the {name} end moves by {1000 * spread.max():.1f} mm (sd) where it should "
        "rest: hold it still, and check that its markers are not confused with others"
    )


class _Ends(NamedTuple):
    heights: NDArray[np.float64]
    """Of the human's and the robot's end [m], shape (n, 2)."""
    rate: float
    """Frames a second."""


def _ends(capture: MotionCapture, clock: Clock, seconds: float) -> _Ends:
    """Return the heights of both ends over some seconds."""
    drained(capture, clock.now())
    wait(clock, seconds)
    came, misdated = drained(capture, clock.now())
    frames = list(in_order(came))
    rate = len(frames) / seconds
    if misdated:
        raise InputError(
            f"{misdated} of {misdated + len(came)} frames have time stamps ahead of this "
            "machine's clock, or none: a stamp is when the frame was captured, on the clock of "
            "the layer (local_clock)"
        )
    if rate < LOWEST_RATE:
        raise InputError(
            f"the motion capture sends {rate:.0f} frames a second, at least {LOWEST_RATE:.0f} are "
            "needed: is it running, and the network fast enough?"
        )
    hidden = sum(not seen(frame) for frame in frames)
    if hidden:
        raise InputError(
            f"a table end was not seen in {hidden} of {len(frames)} frames: are all markers in "
            f"view, and named right?{capture.unseen and ' The last frame: '}{capture.unseen}"
        )
    return _Ends(np.array([(frame.human_end, frame.robot_end) for frame in frames]), rate)


def measure_sag(robot: RobotArm, clock: Clock, readings: int = 10) -> float:
    """Return by how much the hands sag under the table at rest [m], positive downwards."""
    sags = []
    for _ in range(readings):
        state = arm_state(robot)
        sags.append(state.set_point - state.height)
        wait(clock, 0.03)
    sag = float(np.mean(sags))
    if not abs(sag) < LARGEST_OFFSET:
        raise InputError(
            f"the hands are {1000 * sag:.0f} mm below their command, more than "
            f"{1000 * LARGEST_OFFSET:.0f} mm: is the table too heavy, or a motor off?"
        )
    return sag


def move_to(robot: RobotArm, clock: Clock, height: float) -> list[tuple[float, float]]:
    """Move the hands calmly to a height [m]; return times and encoders' heights on the way."""
    seen_heights = []
    while True:
        state = arm_state(robot)
        seen_heights.append((clock.now(), state.height))
        step = max(-CALM_SPEED * PERIOD, min(CALM_SPEED * PERIOD, height - state.set_point))
        with losses_stop():
            commanded = robot.command(state.set_point + step, PERIOD)
        wait(clock, PERIOD)
        if abs(height - state.set_point) < 0.0005 and abs(commanded - height) < 0.0005:
            return seen_heights
        if len(seen_heights) > 200:
            raise InputError(
                f"the hands do not get to {height:.3f} m, they are commanded to "
                f"{state.set_point:.3f} m"
            )


def measure_direction(robot: RobotArm, capture: MotionCapture, clock: Clock) -> Direction:
    """Move the hands a little up and back, and return how the ends moved with them.

    Raises
    ------
    InputError
        If the robot's end does not follow the hands: the ends are swapped, an axis points down, the
        unit is wrong, or the hands do not hold the table.
    """
    drained(capture, clock.now())
    hands = move_to(robot, clock, TEST_MOVE) + move_to(robot, clock, 0.0)
    frames = [frame for frame in in_order(drained(capture, clock.now()).frames) if seen(frame)]
    if len(frames) < 10:
        raise InputError("the motion capture did not see the table while the hands moved")
    times, heights = zip(*hands, strict=True)
    moved = np.interp([frame.time for frame in frames], times, heights)
    direction = Direction(
        slope(moved, [frame.human_end for frame in frames]),
        slope(moved, [frame.robot_end for frame in frames]),
    )
    check_direction(direction)
    return direction


def slope(x: Sequence[float], y: Sequence[float]) -> float:
    """Return the least-squares slope of y over x."""
    centred = np.asarray(x) - np.mean(x)
    return float(centred @ np.asarray(y) / (centred @ centred))


def check_direction(direction: Direction) -> None:
    """Raise an InputError if the robot's end does not move as its hands do."""
    human, robot = direction
    if 0.7 <= robot <= 1.3:
        return
    if 0.7 <= human <= 1.3:
        cause = "the ends are taken for each other: the human's end follows the robot's hands"
    elif -1.3 <= robot <= -0.7:
        cause = "the vertical axis points down"
    elif abs(robot) < 0.3:
        cause = "it stays where it is: do the hands hold the table, are its markers named right?"
    else:
        cause = "is the unit right?"
    raise InputError(f"the robot's end moves by {robot:.2f} m per m that its hands move; {cause}")
