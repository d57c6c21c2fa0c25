"""The two arms of a NAO through NAOqi's ALMotion.

A command is a target on the project's own arm path, given by ``setAngles``: it does not block,
replaces the one before it, and the arms end at its target by themselves. So a robot that hears
nothing more stops within a control period, whatever became of the network.

``setAngles`` moves joints at a fraction of their greatest speeds. Each joint of the left arm gets,
with its mirror image, a call of its own, and the fraction with which it takes the whole duration:
all of them arrive together, and the hands stay within 1.5 mm of a steady rise. With one fraction
for all, the joints with the shorter ways arrive early, and the hands race at up to 2.7 times the
speed that was asked for.
"""

from collections.abc import Sequence
from contextlib import suppress
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ...robots.arm_kinematics import ARM_JOINTS, MIRROR, REST_Z, arm_path, hand_position
from .ports import ArmState, HandLimits, Naoqi, RobotLostError
from .safety import hand_limits, next_command

NAMES: Final = list(ARM_JOINTS)

PAIRS: Final = [(joint, joint + 5) for joint in range(5)]
"""Each joint of the left arm and its mirror image, as places in ``NAMES``."""

SMALLEST_FRACTION: Final = 0.001
"""Smallest fraction of the greatest speed that is asked for; NAOqi takes (0, 1]."""

RELEASE_TIME: Final = 2.0
"""Time in which the stiffness goes up, and down again [s]."""

SLOW: Final = 0.08
"""Fraction of the greatest speed at which the arms go to the rest posture: 0.6 rad/s."""


class NaoqiArm:
    """Both arms as one :class:`.RobotArm`.

    Parameters
    ----------
    session
        The connection.

    Raises
    ------
    InputError
        If the robot is no NAO with arms of five joints.
    RobotLostError
        If it does not answer.
    """

    def __init__(self, session: Naoqi) -> None:
        self.session = session
        rows = [session.call("ALMotion", "getLimits", name)[0] for name in NAMES]
        self._speeds = np.array([row[2] for row in rows])
        self._limits = hand_limits(dict(zip(NAMES, rows, strict=True)))
        self._path = arm_path()
        self._command = 0.0
        self._set_point = 0.0
        self._set_angles: NDArray[np.float64] = np.array(self._path.joint_angles(0.0))
        self._stopped = False
        self.weight_offset = 0.0
        """Added to every command [m], for the sag under the table's weight."""

    @property
    def limits(self) -> HandLimits:
        """What commands are held to; from the robot's own joint limits, the offset included."""
        own, offset = self._limits, self.weight_offset
        return HandLimits(
            low=max(own.low, own.low - offset),
            high=min(own.high, own.high - offset),
            speed=own.speed,
        )

    @property
    def stopped(self) -> bool:
        """Whether the hands are frozen for good."""
        return self._stopped

    def state(self) -> ArmState:
        """Return where the hands are, by encoders and by set-points."""
        measured, set_angles, stiffness = self.session.calls(
            "ALMotion",
            [
                ("getAngles", NAMES, True),
                ("getAngles", NAMES, False),
                ("getStiffnesses", NAMES),
            ],
        )
        self._set_angles = np.array(set_angles)
        height, set_point = hand_heights(np.array([measured, set_angles]))
        self._set_point = set_point - self.weight_offset
        return ArmState(height, self._set_point, min(stiffness))

    def command(self, height: float, duration: float) -> float:
        """Move the hands, within the limits; see :meth:`.RobotArm.command`.

        It starts from where :meth:`state` has last seen the set-points.
        """
        if self._stopped:
            raise RobotLostError("the hands are stopped: no command is taken any more")
        self._command = next_command(height, self._command, self._set_point, duration, self.limits)
        angles = self._path.joint_angles(self._command + self.weight_offset)
        self._send(angles, duration)
        return self._command

    def _send(self, angles: list[float], duration: float) -> None:
        shares = np.abs(np.array(angles) - self._set_angles) / self._speeds / duration
        fractions = np.clip(shares, SMALLEST_FRACTION, 1.0).tolist()
        self.session.calls(
            "ALMotion",
            [
                (
                    "setAngles",
                    [NAMES[left], NAMES[right]],
                    [angles[left], angles[right]],
                    max(fractions[left], fractions[right]),
                )
                for left, right in PAIRS
            ],
        )

    def stop(self) -> None:
        """Freeze the arms where they are, stiff; every later command is refused."""
        self._stopped = True
        with suppress(RobotLostError):
            self.session.call("ALMotion", "killAll")

    def motion(self, method: str, *arguments: Any, within: float = 30.0) -> Any:
        """Call a method of ALMotion that may block."""
        return self.session.call("ALMotion", method, *arguments, within=within)

    def take_hold(self) -> None:
        """Wake the robot, stiffen the arms smoothly and bring them to the rest posture, slowly."""
        if not self.motion("robotIsWakeUp"):
            self.motion("wakeUp")
        if self.state().stiffness < 1.0:
            # A limp arm is not where it was told to be; stiffened, it would jump there.
            here = self.motion("getAngles", NAMES, True)
            self.motion("setAngles", NAMES, here, 1.0)
            self.stiffen(1.0)
        self.motion("angleInterpolationWithSpeed", NAMES, self._path.joint_angles(0.0), SLOW)
        self._command = 0.0
        self.state()

    def stiffen(self, stiffness: float) -> None:
        """Bring the arms' stiffness to a value in [0, 1], smoothly."""
        self.motion("stiffnessInterpolation", ["LArm", "RArm"], stiffness, RELEASE_TIME)

    def release(self) -> None:
        """Take the stiffness from the arms, smoothly, and let the robot go to rest.

        Raises
        ------
        RobotLostError
            If it does not answer.
        """
        self._stopped = True
        self.stiffen(0.0)
        self.motion("rest")

    def say(self, text: str) -> None:
        """Say a text, where the robot can speak; return when it is said."""
        if self.session.has("ALTextToSpeech"):
            self.session.call("ALTextToSpeech", "say", text, within=30.0)


def hand_heights(angles: NDArray[np.float64]) -> Sequence[float]:
    """Return the mean height of both hands [m] for each row of ten arm angles, shape (n, 10)."""
    left, right = angles[:, :5], angles[:, 5:] * np.array(MIRROR)
    heights = hand_position(np.stack([left, right]))[..., 2]
    mean: list[float] = (heights.mean(axis=0) - REST_Z).tolist()
    return mean
