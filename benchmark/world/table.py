"""The table, and the human's hands on it, as a spanning tree of joints.

Ground - slide (x) - hands (z) - pitch hinge - table. The tree carries the human's end; the
holder of the far end closes the loop. The tree's three joints:

* x slides freely: a tilting table needs a few millimetres of slide, to which a human's arms yield.
* z is the height of the human's hands; its mass is the arm's apparent mass.
* pitch is the table's inclination in the human's grip.

A table on a free pin would transmit nothing. A two-handed grip on its edge resists pitching, so
that a height difference is felt: 60 mm over 0.8 m are 75 mrad, 0.75 Nm, about 1 N at the hands.
In the task ``level`` the far end has no such stiffness with either holder: the NAO's fingers do not
resist pitching, and the wrists of a following person yield. A height difference therefore feels the
same with both.
"""

from dataclasses import dataclass
from typing import Final

from colift.robots.nao.kinematics import GRIP_X, REST_Z

TABLE_LENGTH: Final = 0.8
"""Distance between the two grips [m]."""

TABLE_MASS: Final = 0.35
"""Mass of the table [kg]: a dummy table "without significant weight" (paper, section II), within
the 0.33 kg that each of the NAO's two arms can hold at full reach."""

GRIP_STIFFNESS: Final = 10.0
"""Pitch stiffness of a two-handed human grip [Nm/rad]. An assumption: two wrists of some 5 Nm/rad
each, the order of magnitude found for relaxed to lightly tensed wrists."""

GRIP_DAMPING: Final = 0.3
"""Pitch damping of that grip [Nm s/rad]: about half critical for the table about the grip."""

FAR_GRIP_STIFFNESS: Final = 1.0
"""Pitch stiffness of the grip at the far end in tasks with touch [Nm/rad], a tenth of the human's:
an assumption for fingers that hold an edge without clamping it."""

FAR_GRIP_DAMPING: Final = 0.03
"""Pitch damping of that grip [Nm s/rad], in the same ratio to the human's."""

GRAVITY: Final = 9.81
"""Acceleration of gravity [m/s2]."""

TABLE_INERTIA: Final = TABLE_MASS * TABLE_LENGTH**2 / 3
"""Moment of inertia of the table about a grip [kg m2], a thin uniform board."""

WEIGHT_SHARE: Final = TABLE_MASS * GRAVITY / 2
"""The weight that each end carries when the table is level and still [N]."""


@dataclass(frozen=True)
class Table:
    """A table, a thin uniform board of the length :data:`TABLE_LENGTH`.

    Raises
    ------
    ValueError
        If the mass is not positive.
    """

    mass: float = TABLE_MASS
    """[kg]"""

    def __post_init__(self) -> None:
        """Check the mass."""
        if not self.mass > 0:
            raise ValueError(f"mass must be positive, got {self.mass} kg")

    @property
    def inertia(self) -> float:
        """Moment of inertia about a grip [kg m2]."""
        return self.mass * TABLE_LENGTH**2 / 3

    @property
    def weight_share(self) -> float:
        """The weight that each end carries when the table is level and still [N]."""
        return self.mass * GRAVITY / 2


TABLE: Final = Table()
"""The table of the paper."""

FAR_GRIP: Final = (GRIP_X, 0.0, REST_Z)
"""Middle of the far grip at rest [m]; the world's origin is in the NAO's torso."""

SLIDE, HANDS, PITCH = 0, 1, 2
"""Joint indices of the tree; ``PITCH`` is also the index of the table's link."""


def table_urdf(hand_mass: float, far_mass: float = 0.0, table: Table = TABLE) -> str:
    """Return the URDF of the tree; the origin is the human's grip at rest, the table towards -x.

    Parameters
    ----------
    hand_mass
        Apparent mass of the human's arms in z [kg].
    far_mass
        Point mass at the far end [kg]: the arms of a second human, who grips it rigidly.
    table
        The table.
    """
    half = TABLE_LENGTH / 2
    mass = table.mass + far_mass
    centre = (table.mass * half + far_mass * TABLE_LENGTH) / mass
    about_grip = table.inertia + far_mass * TABLE_LENGTH**2
    pitch_inertia = about_grip - mass * centre**2
    small = 1e-3
    # PyBullet reads an empty range as no limit, which saves rows of the solver.
    free = '<limit lower="1" upper="-1" effort="1000" velocity="10"/>'
    return f"""<robot name="human_and_table">
  <link name="ground"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="slide"><inertial><mass value="{hand_mass!r}"/>
    <inertia ixx="{small}" ixy="0" ixz="0" iyy="{small}" iyz="0" izz="{small}"/></inertial></link>
  <link name="hands"><inertial><mass value="{hand_mass!r}"/>
    <inertia ixx="{small}" ixy="0" ixz="0" iyy="{small}" iyz="0" izz="{small}"/></inertial></link>
  <link name="table"><inertial><origin xyz="{-centre!r} 0 0"/><mass value="{mass!r}"/>
    <inertia ixx="{small}" ixy="0" ixz="0" iyy="{pitch_inertia!r}" iyz="0"
      izz="{pitch_inertia!r}"/></inertial></link>
  <joint name="x" type="prismatic"><parent link="ground"/><child link="slide"/>
    <axis xyz="1 0 0"/>{free}</joint>
  <joint name="z" type="prismatic"><parent link="slide"/><child link="hands"/>
    <axis xyz="0 0 1"/>{free}</joint>
  <joint name="pitch" type="revolute"><parent link="hands"/><child link="table"/>
    <axis xyz="0 1 0"/>{free}</joint>
</robot>"""
