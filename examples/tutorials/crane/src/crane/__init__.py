"""A crane."""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from colift.agents.agent import FRAME

STIFFNESS, DAMPING = 3000.0, 150.0
"""Of the rope [N/m] and of the damper [N s/m]."""

SHARE = 0.35 * 9.81 / 2
"""Half of the weight of the table [N]."""


class Hook:
    """A spring and a damper between the commanded height and the table's end."""

    def reset(self):
        """Hold rest height."""
        self.begin = self.end = 0.0

    def prepare(self, command, own, other, force):
        """Take the height to reach at the end of the next frame [m]."""
        self.begin, self.end = self.end, command

    def drive(self, begin, height, velocity):
        """Return the force on the table's end [N] in a physics step."""
        wanted = self.begin + (self.end - self.begin) * begin
        rate = (self.end - self.begin) / FRAME
        return STIFFNESS * (wanted - height) + DAMPING * (rate - velocity) + SHARE

    def hand_height(self, end):
        """Return the height of the hook [m]: that of the table's end."""
        return end


@dataclass(frozen=True)
class Crane:
    """A crane with a hook on a rope."""

    label: ClassVar[str] = "crane"
    control: ClassVar[str] = "a spring"
    mass: ClassVar[float] = 2.0
    carries: ClassVar[bool] = False
    stroke: ClassVar[tuple[float, float]] = (-0.05, 0.5)
    hand_speed: ClassVar[float] = 0.2
    place: ClassVar[tuple[float, float, float]] = (-0.1, 0.0, -0.5)
    foot: ClassVar[float] = 0.0

    def hold(self, engine):
        """Take hold of the table's end."""
        hook = Hook()
        hook.reset()
        return hook

    def model(self):
        """Return the URDF file of the picture."""
        return Path(__file__).with_name("crane.urdf")

    def posture(self, height):
        """Return the joints of the picture for a hook at a height [m]."""
        return {"rope": height}
