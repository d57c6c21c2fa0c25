"""The NAOqi services that an adapter needs, for libqi: same names, arguments and units.

libqi binds the public methods of these classes under their own names, hence the spelling.
"""

# ruff: noqa: A002, N802, N803

import threading
from collections.abc import Callable
from typing import Any, Final

from colift.benchmark.hardware.body import Body, idle_chain
from colift.benchmark.hardware.joint_motion import (
    BODY,
    TICK,
    JointMotion,
    MotionError,
    joint_names,
    per_joint,
)
from colift.robots.nao.facts import JOINTS

VERSION: Final = "2.8.7-emulated"
"""NAOqi of the NAO 6, marked as emulated."""

SPEAKING: Final = 0.05
"""Time that the emulator takes to say a text [s]."""

Log = Callable[[str], None]
"""Takes a line for each event."""

Pause = Callable[[float], None]
"""Lets time pass [s]."""


class MotionService:
    """ALMotion: the calls that ``agents.hardware.nao`` makes."""

    # Otherwise libqi would call one method at a time, and a blocking one would block all.
    __qi_threading__ = "multi"

    def __init__(
        self,
        motion: JointMotion,
        body: Body,
        log: Log,
        pause: Pause,
        answering: threading.Event,
    ) -> None:
        self._motion, self._body = motion, body
        self._log, self._pause = log, pause
        self._awake = True
        self._killed = threading.Event()
        self._answering = answering

    def getBodyNames(self, name: str) -> list[str]:
        """Return the joints of a chain or of ``Body``."""
        return joint_names(name)

    def getLimits(self, name: str) -> list[list[float]]:
        """Return lowest and highest angle [rad], speed [rad/s] and torque [Nm] of each joint."""
        joints = [JOINTS[joint] for joint in joint_names(name)]
        return [[joint.lower, joint.upper, joint.speed, joint.effort] for joint in joints]

    def getAngles(self, names: Any, useSensors: bool) -> list[float]:
        """Return the angles by the encoders, or the set-points [rad]."""
        self._answering.wait()
        joints = joint_names(names)
        return self._motion.measured(joints) if useSensors else self._motion.set_points(joints)

    def getStiffnesses(self, names: Any) -> list[float]:
        """Return the stiffnesses, 0 to 1."""
        return self._motion.stiffness(joint_names(names))

    def setAngles(self, names: Any, angles: Any, fractionMaxSpeed: float) -> None:
        """Move joints; does not block."""
        joints = joint_names(names)
        values = per_joint(angles, len(joints), "angles")
        self._log(f"motion setAngles {values[0]:.4f} {fractionMaxSpeed:.4f}")
        self._motion.set_angles(joints, values, float(fractionMaxSpeed))

    def angleInterpolationWithSpeed(self, names: Any, angles: Any, maxSpeedFraction: float) -> None:
        """Move joints; blocks until they have arrived."""
        joints = joint_names(names)
        values = per_joint(angles, len(joints), "angles")
        self._log(f"motion angleInterpolationWithSpeed {maxSpeedFraction:.4f}")
        self._motion.set_angles(joints, values, float(maxSpeedFraction))
        self._wait(self._motion.moving, joints)

    def setStiffnesses(self, names: Any, stiffnesses: Any) -> None:
        """Set stiffnesses; does not block."""
        joints = joint_names(names)
        self._motion.set_stiffness(joints, per_joint(stiffnesses, len(joints), "stiffnesses"), 0.0)

    def stiffnessInterpolation(self, names: Any, stiffnessLists: Any, timeLists: Any) -> None:
        """Bring joints to one stiffness each within a time [s]; blocks."""
        if isinstance(stiffnessLists, list) or isinstance(timeLists, list):
            raise MotionError("ALMotion (emulated): one stiffness and one time for all joints")
        joints = joint_names(names)
        self._log(f"stiffness {stiffnessLists:g} {timeLists:g}")
        values = [float(stiffnessLists)] * len(joints)
        self._motion.set_stiffness(joints, values, float(timeLists))
        self._wait(self._motion.stiffening, joints)

    def _wait(self, going_on: Callable[[list[str]], bool], joints: list[str]) -> None:
        """Wait while the joints move or stiffen, or until all motion is killed."""
        self._killed.clear()
        while going_on(joints) and not self._killed.is_set():
            self._pause(TICK)

    def killAll(self) -> None:
        """Stop everything that moves."""
        self._log("killAll")
        self._killed.set()
        self._motion.kill()

    def killMove(self) -> None:
        """Stop walking: the emulated robot does not walk."""
        self._log("killMove")

    def robotIsWakeUp(self) -> bool:
        """Return whether the motors are on."""
        return self._awake

    def wakeUp(self) -> None:
        """Switch the motors on; the emulated robot stands at the table, and stays there."""
        self._log("wakeUp")
        self._awake = True
        self._motion.set_stiffness(BODY, [1.0] * len(BODY), 0.5)
        self._wait(self._motion.stiffening, list(BODY))

    def rest(self) -> None:
        """Switch the motors off."""
        self._log("rest")
        self._awake = False
        self._motion.set_stiffness(BODY, [0.0] * len(BODY), 0.5)
        self._wait(self._motion.stiffening, list(BODY))

    def getFallManagerEnabled(self) -> bool:
        """Return that the fall manager is on."""
        return True

    def getCollisionProtectionEnabled(self, pChainName: str) -> bool:
        """Return that the protection of an arm from self-collision is on."""
        if pChainName not in ("LArm", "RArm", "Arms"):
            raise MotionError(f"ALMotion: {pChainName!r} is not LArm, RArm or Arms")
        return True

    def getBreathEnabled(self, pChain: str) -> bool:
        """Return whether a chain breathes when it has no command."""
        return self._body.breathing and idle_chain(pChain) not in ("Legs", "Head")

    def getIdlePostureEnabled(self, pChain: str) -> bool:
        """Return whether a chain has an idle posture, to which it returns without a command."""
        return self._body.idle_posture and idle_chain(pChain) not in ("Legs", "Head")

    def getSmartStiffnessEnabled(self) -> bool:
        """Return that smart stiffness is off: the emulated motors do not save power."""
        return False


class MemoryService:
    """ALMemory: values by name, shared by all clients."""

    __qi_threading__ = "multi"

    def __init__(self, body: Body, log: Log) -> None:
        self._body, self._log = body, log
        self._data: dict[str, Any] = {}

    def insertData(self, key: str, value: Any) -> None:
        """Store a value under a key."""
        known = self._data.get(key)
        self._data[key] = value
        # A heartbeat changes only the last of several values, and is not logged.
        if not (isinstance(known, list) and isinstance(value, list) and known[:-1] == value[:-1]):
            self._log(f"memory {key}: {value}")

    def getData(self, key: str) -> Any:
        """Return the value of a key."""
        known = self._known()
        if key not in known:
            raise MotionError(f"ALMemory: there is no data under the key {key!r}")
        return known[key]

    def getListData(self, keys: list[str]) -> list[Any]:
        """Return the values of keys; None for a key without one."""
        known = self._known()
        return [known.get(key) for key in keys]

    def _known(self) -> dict[str, Any]:
        return {**self._body.sensors(), **self._data}

    def getDataList(self, filter: str) -> list[str]:
        """Return the keys that contain a text."""
        return [key for key in self._known() if filter in key]

    def removeData(self, key: str) -> None:
        """Forget a key."""
        self._data.pop(key, None)


class BatteryService:
    """ALBattery: the charge."""

    def __init__(self, body: Body) -> None:
        self._body = body

    def getBatteryCharge(self) -> int:
        """Return the charge [%]."""
        return self._body.charge


class PostureService:
    """ALRobotPosture: the robot stands."""

    def getPosture(self) -> str:
        """Return the posture."""
        return "Stand"

    def getPostureFamily(self) -> str:
        """Return the family of the posture."""
        return "Standing"


class LifeService:
    """ALAutonomousLife: the robot does nothing of its own accord."""

    def getState(self) -> str:
        """Return the state."""
        return "disabled"


class SpeechService:
    """ALTextToSpeech: the person hears what the robot says."""

    def __init__(self, heard: Callable[[str], None], log: Log, pause: Pause) -> None:
        self._heard, self._log, self._pause = heard, log, pause

    def say(self, text: str) -> None:
        """Say a text; takes as long as speaking does."""
        self._log(f"say {text}")
        self._pause(SPEAKING)
        self._heard(text)


class FaultService:
    """ColiftFaults: schedules faults; a real robot has no such service."""

    def __init__(self, request: Callable[[str], float], clear: Callable[[], None]) -> None:
        self._request, self._clear = request, clear

    def request(self, fault: str) -> float:
        """Schedule a fault ``KIND@START[:DURATION[:VALUE]]``; return the emulator's time [s]."""
        return self._request(fault)

    def clear(self) -> None:
        """End all faults, except that closed connections stay closed."""
        self._clear()


class SystemService:
    """ALSystem: name and version of the robot."""

    def robotName(self) -> str:
        """Return the robot's name."""
        return "emulated"

    def systemVersion(self) -> str:
        """Return NAOqi's version."""
        return VERSION
