"""The parts of a robot: shapes, links and joints, and their mirror images.

Frames: x forward, y left, z up. Units: m, kg, kg m^2, rad, rad/s, N m.
"""

from dataclasses import dataclass, replace
from math import inf
from typing import Final

Vector = tuple[float, float, float]
"""x, y, z."""
Inertia = tuple[float, float, float, float, float, float]
"""xx, xy, xz, yy, yz, zz [kg m^2]."""
Colour = tuple[float, float, float]
"""Red, green, blue in 0..1."""

GREY: Final = (0.62, 0.63, 0.65)


@dataclass(frozen=True)
class Shape:
    """A box (x, y, z lengths), cylinder (radius, length; along its own z) or sphere (radius)."""

    size: tuple[float, ...]
    """Dimensions [m]; their number determines the solid."""
    at: Vector
    """Centre in the link's frame [m]."""
    colour: Colour = GREY
    """Its colour, if it is visible."""
    rpy: Vector = (0.0, 0.0, 0.0)
    """Roll, pitch, yaw in the link's frame [rad]."""

    def mirrored(self) -> "Shape":
        """Return the mirror image in the x-z plane."""
        (x, y, z), (roll, pitch, yaw) = self.at, self.rpy
        return replace(self, at=(x, 0.0 - y, z), rpy=(0.0 - roll, pitch, 0.0 - yaw))


@dataclass(frozen=True, kw_only=True)
class Joint:
    """A revolute joint: the child's frame is the parent's, moved by ``origin`` and ``rpy``.

    Limits are infinite where none is published.
    """

    name: str
    parent: str
    child: str
    origin: Vector
    """Position of the joint in the parent's frame [m]."""
    axis: Vector
    """Axis of rotation in the joint's frame."""
    lower: float = -inf
    """Lower limit [rad]."""
    upper: float = inf
    """Upper limit [rad]."""
    speed: float = inf
    """Largest speed [rad/s]."""
    effort: float = inf
    """Largest torque [N m]."""
    rpy: Vector = (0.0, 0.0, 0.0)
    """Roll, pitch and yaw of the joint's frame in the parent's [rad]."""
    mimic: str = ""
    """The joint whose motor drives this one too; empty if it has its own."""
    mimic_ratio: float = 1.0
    """Angle of this joint per angle of the mimicked one."""


@dataclass(frozen=True, kw_only=True)
class Link:
    """A rigid body."""

    name: str
    mass: float
    """Mass [kg]."""
    com: Vector
    """Centre of mass in the link's frame [m]."""
    inertia: Inertia
    """Moments and products of inertia about the centre of mass, in the link's axes."""
    visuals: tuple[Shape, ...] = ()
    """Its visible shapes."""
    collisions: tuple[Shape, ...] = ()
    """Its shapes in contacts."""

    def times(self, factor: float) -> "Link":
        """Return it with a multiple of its mass and inertia."""
        xx, xy, xz, yy, yz, zz = (factor * each for each in self.inertia)
        return replace(self, mass=factor * self.mass, inertia=(xx, xy, xz, yy, yz, zz))


def mirrored_name(name: str) -> str:
    """Return the right side's name of a left joint or link, and the name itself of a middle one."""
    return {"L": "R", "l": "r"}[name[0]] + name[1:] if name[0] in "Ll" else name


def mirrored_joint(joint: Joint) -> Joint:
    """Mirror a joint in the torso's x-z plane.

    A pitch axis stays and keeps its sign; NAO's roll and yaw axes keep pointing along +x and +z,
    so that their angles, and with them the limits, change sign.
    """
    x, y, z = joint.origin
    ax, ay, az = joint.axis
    pitch = ay != 0.0
    return replace(
        joint,
        name=mirrored_name(joint.name),
        parent=mirrored_name(joint.parent),
        child=mirrored_name(joint.child),
        origin=(x, 0.0 - y, z),
        axis=(0.0 - ax, ay, 0.0 - az) if pitch else joint.axis,
        lower=joint.lower if pitch else 0.0 - joint.upper,
        upper=joint.upper if pitch else 0.0 - joint.lower,
    )


def mirrored_link(link: Link) -> Link:
    """Mirror a link in the x-z plane: y and the products of inertia with y change sign."""
    x, y, z = link.com
    xx, xy, xz, yy, yz, zz = link.inertia
    return replace(
        link,
        name=mirrored_name(link.name),
        com=(x, 0.0 - y, z),
        inertia=(xx, 0.0 - xy, xz, yy, 0.0 - yz, zz),
    )
