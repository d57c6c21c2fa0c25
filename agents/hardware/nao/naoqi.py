"""The two arms of a NAO through NAOqi's ALMotion.

A command is a target on the project's own arm path, given by ``setAngles``: it does not block,
replaces the one before it, and the arms stop at its target by themselves. A robot that receives no
more commands therefore stops within a control period, whatever happened to the network.

``setAngles`` moves joints at a fraction of their greatest speeds. Each joint of the left arm, with
its mirror image, gets a call of its own, with the fraction at which the movement takes the whole
duration: all joints arrive together, and the hands stay within 1.5 mm of a steady rise. With one
fraction for all, the joints with shorter paths would arrive early, and the hands would move at up
to 2.7 times the requested speed.
"""

import dataclasses
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any, Final

import numpy as np
from colift.agents.hardware.clocks import awake_or_asleep
from colift.agents.hardware.ports import (
    ArmState,
    HandLimits,
    Naoqi,
    RobotLostError,
    RobotTakenError,
)
from colift.agents.hardware.safety import ASTRAY, hand_limits, next_command
from colift.robots.nao.kinematics import ARM_JOINTS, MIRROR, REST_Z, arm_path, hand_position
from numpy.typing import NDArray

NAMES: Final = list(ARM_JOINTS)

ARMS: Final = ["LArm", "RArm"]
"""The chains of the arms."""

PAIRS: Final = [(joint, joint + 5) for joint in range(5)]
"""Each joint of the left arm and its mirror image, as places in ``NAMES``."""

SMALLEST_FRACTION: Final = 0.001
"""Smallest requested fraction of the greatest speed; NAOqi accepts (0, 1]."""

RELEASE_TIME: Final = 2.0
"""Time in which the stiffness goes up, and down again [s]."""

SLOW: Final = 0.08
"""Fraction of the greatest speed at which the arms go to the rest posture: 0.6 rad/s."""

EARLIER: Final = 64
"""Number of commands of which a late one is recognised."""

STALE: Final = 3.0
"""Time without a heartbeat after which a claim is dead [s]: six of them."""

LAG: Final = 0.3
"""Longest time by which set-points may lag behind their commands [s]: two ALMotion cycles (0.04 s),
the longest wait for an answer (0.15 s), and a margin for a busy robot."""


class NaoqiArm:
    """Both arms as one :class:`.RobotArm`.

    Parameters
    ----------
    session
        The connection.

    Raises
    ------
    InputError
        If the robot is not a NAO with arms of five joints.
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
        # Joint angles of this client's last commands, and the number of them that count.
        self._targets = deque([self._set_angles])
        self._kept = 2
        self._given = deque([self._set_angles], maxlen=EARLIER)
        self._stopped = False
        self.taken = ""
        """Message naming another client that commands the robot, else empty; once it is set,
        nothing more is sent to the robot."""
        self.look: Callable[[], None] = lambda: None
        """Looks whether another client commands the robot, and sets ``taken``."""
        self._last_state = awake_or_asleep()
        self.weight_offset = 0.0
        """Added to every command [m], for the sag under the table's weight."""

    @property
    def limits(self) -> HandLimits:
        """Limits of the commands, from the robot's own joint limits; the offset is included."""
        own, offset = self._limits, self.weight_offset
        low, high = max(own.low, own.low - offset), min(own.high, own.high - offset)
        return dataclasses.replace(own, low=low, high=high)

    @property
    def stopped(self) -> bool:
        """Whether the hands are frozen for good."""
        return self._stopped

    def state(self) -> ArmState:
        """Return the state of the hands; see :meth:`.RobotArm.state`."""
        self.refuse_if_taken()
        measured, set_angles, stiffness = self.session.calls(
            "ALMotion",
            [
                ("getAngles", NAMES, True),
                ("getAngles", NAMES, False),
                ("getStiffnesses", NAMES),
            ],
        )
        self._last_state = awake_or_asleep()
        targets = np.array(self._targets)
        # A joint is on its way between its last seen set-point and its newest targets. The range of
        # all recent targets limits this: otherwise a joint held by another client would never be
        # astray.
        way = np.array([self._set_angles, *targets[-3:]])
        low = np.maximum(way.min(axis=0), targets.min(axis=0))
        high = np.minimum(way.max(axis=0), targets.max(axis=0))
        now = self._set_angles = np.array(set_angles)
        self._targets.append(targets[-1])
        while len(self._targets) > self._kept:
            self._targets.popleft()
        outside = np.maximum(low - now, now - high)
        height, set_point = hand_heights(np.array([measured, set_angles]))
        self._set_point = set_point - self.weight_offset
        astray = max(0.0, float(outside.max()))
        late = astray > ASTRAY and distance_to_path(now, np.array(self._given)) <= ASTRAY
        return ArmState(height, self._set_point, min(stiffness), astray, late)

    def command(self, height: float, duration: float) -> float:
        """Move the hands, within the limits; see :meth:`.RobotArm.command`.

        It starts from the set-points that :meth:`state` read last.
        """
        self._refuse_if_stopped()
        self.refuse_if_taken()
        self._command = next_command(height, self._command, self._set_point, duration, self.limits)
        self._kept = 1 + round(LAG / duration)
        angles = self._path.joint_angles(self._command + self.weight_offset)
        self._send(angles, duration)
        return self._command

    def _refuse_if_stopped(self) -> None:
        if self._stopped:
            raise RobotLostError("the hands are stopped: no more commands are accepted")

    def refuse_if_taken(self) -> None:
        """Raise a :class:`.RobotTakenError` if another client commands the robot."""
        if self.taken:
            raise RobotTakenError(self.taken)

    def _send(self, angles: list[float], duration: float) -> None:
        shares = np.abs(np.array(angles) - self._set_angles) / self._speeds / duration
        fractions = np.clip(shares, SMALLEST_FRACTION, 1.0).tolist()
        self._targets[-1] = np.array(angles)
        self._given.append(self._targets[-1])
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
        """Freeze the arms where they are, stiff; every later command is refused.

        Arms that another client commands are left alone: after a pause in which the claim may have
        died, this looks first.
        """
        self._stopped = True
        if awake_or_asleep() - self._last_state > STALE:
            with suppress(RobotLostError):
                self.look()
        if not self.taken:
            with suppress(RobotLostError):
                self.session.call("ALMotion", "killAll")

    def answers(self) -> bool:
        """Return whether the robot answers."""
        try:
            self.session.call("ALMotion", "robotIsWakeUp")
        except RobotLostError:
            return False
        return True

    def motion(self, method: str, *arguments: Any, within: float = 30.0) -> Any:
        """Call a method of ALMotion that may block."""
        return self.session.call("ALMotion", method, *arguments, within=within)

    def take_hold(self) -> None:
        """Wake the robot, stiffen the arms smoothly and bring them to the rest posture, slowly.

        Raises
        ------
        RobotLostError
            If it does not answer, or another thread stops the arms meanwhile.
        """
        if not self.motion("robotIsWakeUp"):
            self._move("wakeUp")
        if self.state().stiffness < 1.0:
            # A limp arm is away from its set-points, and would jump to them when stiffened.
            here = self.motion("getAngles", NAMES, True)
            self._move("setAngles", NAMES, here, 1.0)
            self._move("stiffnessInterpolation", ARMS, 1.0, RELEASE_TIME)
        rest = self._path.joint_angles(0.0)
        self._move("angleInterpolationWithSpeed", NAMES, rest, SLOW)
        self._command = 0.0
        self.state()
        self._targets = deque([np.array(rest)])
        self._given = deque(self._targets, maxlen=EARLIER)

    def _move(self, method: str, *arguments: Any) -> None:
        """Call a method of ALMotion that moves or stiffens something."""
        self._refuse_if_stopped()
        self.motion(method, *arguments)

    def release(self) -> None:
        """Reduce the arms' stiffness to 0, smoothly, and let the robot go to rest.

        Raises
        ------
        RobotLostError
            If it does not answer.
        RobotTakenError
            If another client commands it.
        """
        self._stopped = True
        self.refuse_if_taken()
        self.motion("stiffnessInterpolation", ARMS, 0.0, RELEASE_TIME)
        self.motion("rest")

    def say(self, text: str) -> None:
        """Say a text, if the robot can speak; return when it has been said."""
        if self.session.has("ALTextToSpeech"):
            self.session.call("ALTextToSpeech", "say", text, within=30.0)


def distance_to_path(angles: NDArray[np.float64], path: NDArray[np.float64]) -> float:
    """Return the distance of joint angles from a path of straight lines [rad].

    On the way from one command to the next, all joints move at constant speeds: the set-points of a
    late command are on this path, and those that somebody else gives to a joint are not.

    Parameters
    ----------
    angles
        Angles of the joints [rad], shape (j,).
    path
        Its corners [rad], shape (n, j); at least one.

    Returns
    -------
    float
        The largest difference of a joint from the nearest point (by the sum of squares) of the
        nearest line.
    """
    begins, ways = path, np.diff(path, axis=0, append=path[-1:])
    lengths = np.maximum((ways**2).sum(axis=1), np.finfo(float).tiny)
    shares = np.clip(((angles - begins) * ways).sum(axis=1) / lengths, 0.0, 1.0)
    nearest = begins + shares[:, None] * ways
    return float(np.abs(nearest - angles).max(axis=1).min())


def hand_heights(angles: NDArray[np.float64]) -> Sequence[float]:
    """Return the mean height of both hands [m] for each row of ten arm angles, shape (n, 10)."""
    left, right = angles[:, :5], angles[:, 5:] * np.array(MIRROR)
    heights = hand_position(np.stack([left, right]))[..., 2]
    mean: list[float] = (heights.mean(axis=0) - REST_Z).tolist()
    return mean
