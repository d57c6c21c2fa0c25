"""Joint commands of ALMotion, as far as documented: names, limits, 20 ms ticks.

Sources: Aldebaran documentation, "Joint control API" and "Stiffness control API" of NAOqi 1.14 and
2.8 (names, chains, blocking or not, units; ALMotion runs at 50 Hz), and "General tools API"
(``getLimits``). Angles outside a joint's limits are clipped to them.
"""

import threading
from collections.abc import Mapping, Sequence
from typing import Any, Final

from colift.robots.nao.facts import JOINTS

TICK: Final = 0.02
"""Cycle of ALMotion [s]: it accepts commands and moves set-points at 50 Hz."""

CHAINS: Final[Mapping[str, tuple[str, ...]]] = {
    "Head": ("HeadYaw", "HeadPitch"),
    **{
        f"{side}Arm": tuple(
            f"{side}{joint}"
            for joint in (
                "ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw", "Hand",
            )
        )
        for side in "LR"
    },
    **{
        f"{side}Leg": tuple(
            f"{side}{joint}"
            for joint in (
                "HipYawPitch", "HipRoll", "HipPitch", "KneePitch", "AnklePitch", "AnkleRoll",
            )
        )
        for side in "LR"
    },
}  # fmt: skip
"""Joints of each chain, in NAOqi's order."""

BODY: Final = (
    *CHAINS["Head"], *CHAINS["LArm"], *CHAINS["LLeg"], *CHAINS["RLeg"], *CHAINS["RArm"],
)  # fmt: skip
"""All joints, in NAOqi's order."""


class MotionError(RuntimeError):
    """A call that ALMotion refuses; the message is the answer to the caller."""


def joint_names(names: str | Sequence[str]) -> list[str]:
    """Return the joints that a name, a chain, ``Body`` or a list of them stands for.

    Raises
    ------
    MotionError
        If one is unknown.
    """
    if isinstance(names, str):
        if names == "Body":
            return list(BODY)
        if names == "Arms":
            return [*CHAINS["LArm"], *CHAINS["RArm"]]
        if names in CHAINS:
            return list(CHAINS[names])
        if names in BODY:
            return [names]
        raise MotionError(f"ALMotion: {names!r} is not a joint, chain or 'Body'")
    return [joint for name in names for joint in joint_names(name)]


def per_joint(value: Any, count: int, what: str) -> list[float]:
    """Return one number for each joint; a single one stands for all.

    Raises
    ------
    MotionError
        If there are fewer or more numbers than joints, or they are not numbers.
    """
    try:
        if isinstance(value, list | tuple):
            values = [float(each) for each in value]
        else:
            values = [float(value)] * count
    except (TypeError, ValueError):
        raise MotionError(f"ALMotion: {what} must be numbers, got {value!r}") from None
    if len(values) != count:
        raise MotionError(f"ALMotion: {count} joint(s) need {count} {what}, got {len(values)}")
    return values


def clipped(joint: str, angle: float) -> float:
    """Return an angle clipped to the joint's limits [rad]."""
    return min(max(angle, JOINTS[joint].lower), JOINTS[joint].upper)


class JointMotion:
    """Set-points, targets and stiffnesses of all joints; any thread may call.

    Set-points move to their targets at a constant speed, a fraction of the joint's greatest, tick
    by tick. NAOqi smooths the beginning and the end of the motion, in a way that is not documented.
    """

    def __init__(self, start: Mapping[str, float]) -> None:
        self._lock = threading.Lock()
        self._set_points = {joint: start.get(joint, 0.0) for joint in BODY}
        self._measured = dict(self._set_points)
        self._moves: dict[str, tuple[float, float]] = {}
        self._stiffness = dict.fromkeys(BODY, 1.0)
        self._ramps: dict[str, tuple[float, float]] = {}
        self._off = False
        self._breath: dict[str, float] = {}

    def tick(self) -> None:
        """Advance all set-points and stiffnesses by one cycle."""
        with self._lock:
            for joint, (target, speed) in list(self._moves.items()):
                self._set_points[joint] = stepped(self._set_points[joint], target, speed * TICK)
                if self._set_points[joint] == target:
                    del self._moves[joint]
            for joint, (target, rate) in list(self._ramps.items()):
                self._stiffness[joint] = stepped(self._stiffness[joint], target, rate * TICK)
                if self._stiffness[joint] == target:
                    del self._ramps[joint]

    def breathe(self, joint: str, angle: float) -> None:
        """Add a movement of the robot's own to a set-point, unless the joint follows a command.

        Parameters
        ----------
        joint
            The joint.
        angle
            Distance from where it is without that movement [rad]; 0 at first and at last.
        """
        with self._lock:
            more = angle - self._breath.get(joint, 0.0)
            self._breath[joint] = angle
            if joint not in self._moves:
                self._set_points[joint] = clipped(joint, self._set_points[joint] + more)

    def set_angles(self, names: Sequence[str], angles: Sequence[float], fraction: float) -> None:
        """Move joints to angles at a fraction of their greatest speeds.

        Raises
        ------
        MotionError
            If the fraction is not in (0, 1].
        """
        if not 0.0 < fraction <= 1.0:
            raise MotionError(f"ALMotion: fractionMaxSpeed must be in ]0, 1], got {fraction}")
        with self._lock:
            for joint, angle in zip(names, angles, strict=True):
                self._moves[joint] = (clipped(joint, angle), fraction * JOINTS[joint].speed)

    def set_stiffness(self, names: Sequence[str], values: Sequence[float], time: float) -> None:
        """Bring joints to stiffnesses, clipped to [0, 1], within a time [s]."""
        with self._lock:
            for joint, value in zip(names, values, strict=True):
                target = min(max(value, 0.0), 1.0)
                distance = abs(target - self._stiffness[joint])
                self._ramps[joint] = (target, distance / max(time, TICK))

    def kill(self) -> None:
        """Forget all targets: the joints stay where they are."""
        with self._lock:
            self._moves.clear()

    def motors_off(self, off: bool) -> None:
        """Switch the stiffness of every motor off, or on again: a fault."""
        with self._lock:
            self._off = off

    def moving(self, names: Sequence[str]) -> bool:
        """Return whether one of the joints is moving."""
        with self._lock:
            return any(joint in self._moves for joint in names)

    def stiffening(self, names: Sequence[str]) -> bool:
        """Return whether the stiffness of one of the joints is changing."""
        with self._lock:
            return any(joint in self._ramps for joint in names)

    def set_points(self, names: Sequence[str]) -> list[float]:
        """Return set-points [rad]."""
        with self._lock:
            return [self._set_points[joint] for joint in names]

    def measured(self, names: Sequence[str]) -> list[float]:
        """Return encoders' angles [rad]; joints that are not simulated are at their set-points."""
        with self._lock:
            return [self._measured.get(joint, self._set_points[joint]) for joint in names]

    def measure(self, angles: Mapping[str, float]) -> None:
        """Store the encoders' angles."""
        with self._lock:
            self._measured = dict(angles)

    def stiffness(self, names: Sequence[str]) -> list[float]:
        """Return stiffnesses, 0 to 1."""
        with self._lock:
            return [0.0 if self._off else self._stiffness[joint] for joint in names]


def stepped(value: float, target: float, step: float) -> float:
    """Return a value moved towards a target by at most a step."""
    return target if abs(target - value) <= step else value + (step if target > value else -step)
