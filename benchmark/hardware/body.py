"""The body of the emulated robot, apart from its posture: heat, battery, movements of its own."""

from dataclasses import dataclass
from typing import Final

from colift.benchmark.hardware.joint_motion import BODY, MotionError

IDLE_CHAINS: Final = ("Body", "Legs", "Arms", "LArm", "RArm", "Head")
"""Chains that may have a movement of their own."""

WARM: Final = 38.0
"""Temperature of a joint without a fault [degrees Celsius]."""

CHARGE: Final = 90
"""Charge of the battery without a fault [%]."""


def idle_chain(name: str) -> str:
    """Return the name of a chain that may have a movement of its own.

    Raises
    ------
    MotionError
        If there is none.
    """
    if name not in IDLE_CHAINS:
        raise MotionError(f"ALMotion: {name!r} is not one of {', '.join(IDLE_CHAINS)}")
    return name


@dataclass
class Body:
    """What the robot's body is like, apart from its posture; faults change it."""

    elbow: float = WARM
    """Temperature of the left elbow [degrees Celsius]."""
    charge: int = CHARGE
    """Charge of the battery [%]."""
    breathing: bool = False
    """Whether the arms breathe."""
    idle_posture: bool = False
    """Whether the arms have an idle posture."""

    def sensors(self) -> dict[str, float]:
        """Return the sensors that ALMemory knows, by their keys."""
        temperatures = dict.fromkeys(BODY, WARM) | {"LElbowRoll": self.elbow}
        return {
            f"Device/SubDeviceList/{joint}/Temperature/Sensor/Value": value
            for joint, value in temperatures.items()
        }
