"""The servos that hold the NAO's joints in position."""

from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True, kw_only=True)
class Servo:
    """The position servo of the NAO's arm joints."""

    time: float = 0.02
    """Time constant with which a joint follows its set-point [s]: one cycle of the NAO's motion
    thread (20 ms)."""

    stiffness: float = 18.0
    """Torque that displaces a joint, divided by the displacement [Nm/rad]. An assumption: the arm
    motors' nominal torque (0.55 Nm at the shoulder) displaces a joint by 1.75 degrees."""

    load_time: float = 0.03
    """Time constant with which a joint yields to a changing load [s], an assumption."""

    weight_offset: bool = True
    """Whether the set-point compensates for the sag at rest under the table's weight, which the
    paper's authors had to do as well (section II.B)."""


SERVO: Final = Servo()
