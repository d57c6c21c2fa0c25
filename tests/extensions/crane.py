"""A laboratory's own robot: one module and an entry point."""

import os
from dataclasses import dataclass
from pathlib import Path
from tempfile import gettempdir
from typing import ClassVar

from colift.agents.agent import FRAME

ENTRY_POINTS = """\
[colift.robots]
crane = crane:Crane
"""

STIFFNESS, DAMPING = 3000.0, 150.0
"""Of the hoist [N/m], [N s/m]."""

MODEL = """<robot name="crane">
  <link name="mast"><visual><origin xyz="0 0 0.5"/><geometry><box size="0.1 0.1 1"/></geometry>
  </visual></link>
  <link name="hook"><visual><geometry><sphere radius="0.05"/></geometry></visual></link>
  <joint name="hoist" type="prismatic"><parent link="mast"/><child link="hook"/>
    <origin xyz="0.1 0 0.5"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>"""


class Hook:
    """A spring and a damper between the table's end and the commanded height."""

    def reset(self):
        """Rest."""
        self._from = self._to = 0.0

    def prepare(self, command, own, other, force):
        """Take the commanded height for the end of the next frame [m]."""
        self._from, self._to = self._to, command

    def drive(self, begin, height, velocity):
        """Return the force on the table's end [N]."""
        wanted = self._from + (self._to - self._from) * begin
        rate = (self._to - self._from) / FRAME
        return STIFFNESS * (wanted - height) + DAMPING * (rate - velocity) + 0.35 * 9.81 / 2

    def hand_height(self, end):
        """Return the height of the hook [m]."""
        return end


@dataclass(frozen=True)
class Crane:
    """A crane with a spring."""

    mass: ClassVar[float] = 2.0
    carries: ClassVar[bool] = False
    label: ClassVar[str] = "crane"
    control: ClassVar[str] = "a spring"
    stroke: ClassVar[tuple[float, float]] = (-0.05, 0.5)
    hand_speed: ClassVar[float] = 0.2
    place: ClassVar[tuple[float, float, float]] = (0.0, 0.0, -0.5)
    foot: ClassVar[float] = 0.0

    def hold(self, engine):
        """Hook the table's end."""
        hook = Hook()
        hook.reset()
        return hook

    def model(self):
        """Return the URDF file of its picture."""
        path = Path(gettempdir(), f"crane-{os.getuid()}.urdf")
        path.write_text(MODEL)
        return path

    def posture(self, height):
        """Return the height of its hook [m]."""
        return {"hoist": height}
