"""The NAO H25 V5 in numbers: joints, links, lengths.

Sources, by quantity:

- *link lengths*: Aldebaran documentation, page "H25 - Links";
- *all else* (joint limits, speeds and efforts, masses, centres of mass, inertias, fingers): the ROS
  package ``nao_description`` (github.com/ros-naoqi/nao_robot, commit 67476469), the URDF that it
  generates for V5.0 from the maker's tables.

Frames: x forward, y left, z up, all parallel to the torso's in the zero posture (legs straight,
arms stretched forward). Units: m, kg, kg m^2, rad, rad/s, N m.

The left half is written down and the right half is its mirror image, because a robot that is
stronger or heavier on one side would tilt the table. The published right half differs from the
mirror image in the ankle's pitch limits (kept) and in details that ``nao_urdf/README.md`` lists.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from colift.robots.description.parts import (
    Inertia,
    Joint,
    Link,
    Vector,
    mirrored_joint,
    mirrored_link,
)

NECK_OFFSET_Z: Final = 0.1265
"""Torso origin to the head's joints [m]."""
SHOULDER_OFFSET_Y: Final = 0.098
"""Torso's middle plane to the shoulder [m]."""
SHOULDER_OFFSET_Z: Final = 0.100
"""Torso origin up to the shoulder [m]."""
UPPER_ARM_LENGTH: Final = 0.105
"""Shoulder to elbow, along the upper arm [m]."""
ELBOW_OFFSET_Y: Final = 0.015
"""Shoulder to elbow, across the upper arm, outwards [m]."""
LOWER_ARM_LENGTH: Final = 0.05595
"""Elbow to wrist [m]."""
HAND_OFFSET_X: Final = 0.05775
"""Wrist to hand point, along the forearm [m]."""
HAND_OFFSET_Z: Final = 0.01231
"""Wrist down to the hand point, palm down [m]."""
HIP_OFFSET_Y: Final = 0.050
"""Torso's middle plane to the hip [m]."""
HIP_OFFSET_Z: Final = 0.085
"""Torso origin down to the hip [m]."""
THIGH_LENGTH: Final = 0.100
"""Hip to knee [m]."""
TIBIA_LENGTH: Final = 0.1029
"""Knee to ankle [m]."""
FOOT_HEIGHT: Final = 0.04519
"""Ankle to sole [m]."""

TORSO_HEIGHT: Final = 0.333
"""Torso origin above the floor, standing straight [m]: hip, thigh, tibia and foot, to the mm."""

ARM: Final = ("ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw")
"""The five joints of an arm, from the shoulder outwards, without their side's letter."""

_X: Final = (1.0, 0.0, 0.0)
_Y: Final = (0.0, 1.0, 0.0)
_Z: Final = (0.0, 0.0, 1.0)
_HIP_YAW_PITCH: Final = (0.0, 0.707106, -0.707106)
_HERE: Final = (0.0, 0.0, 0.0)
_NECK: Final = (0.0, 0.0, NECK_OFFSET_Z)
_HIP: Final = (0.0, HIP_OFFSET_Y, -HIP_OFFSET_Z)
_KNEE: Final = (0.0, 0.0, -THIGH_LENGTH)
_ANKLE: Final = (0.0, 0.0, -TIBIA_LENGTH)
_SHOULDER: Final = (0.0, SHOULDER_OFFSET_Y, SHOULDER_OFFSET_Z)
_ELBOW: Final = (UPPER_ARM_LENGTH, ELBOW_OFFSET_Y, 0.0)
_WRIST: Final = (LOWER_ARM_LENGTH, 0.0, 0.0)
_HAND: Final = (HAND_OFFSET_X, 0.0, -HAND_OFFSET_Z)

# name, parent, child, origin, axis, lower, upper, speed, effort
_MIDDLE_JOINTS: Final = (
    ("HeadYaw", "torso", "Neck", _NECK, _Z, -2.08567, 2.08567, 8.26797, 1.547),
    ("HeadPitch", "Neck", "Head", _HERE, _Y, -0.671952, 0.514872, 7.19407, 1.532),
)
_LEFT_JOINTS: Final = (
    ("LHipYawPitch", "torso", "LPelvis", _HIP, _HIP_YAW_PITCH, -1.14529, 0.740718, 4.16174, 3.348),
    ("LHipRoll", "LPelvis", "LHip", _HERE, _X, -0.379435, 0.79046, 4.16174, 3.348),
    ("LHipPitch", "LHip", "LThigh", _HERE, _Y, -1.53589, 0.48398, 6.40239, 3.023),
    ("LKneePitch", "LThigh", "LTibia", _KNEE, _Y, -0.0923279, 2.11255, 6.40239, 3.023),
    ("LAnklePitch", "LTibia", "LAnklePitch", _ANKLE, _Y, -1.18944, 0.922581, 6.40239, 3.023),
    ("LAnkleRoll", "LAnklePitch", "l_ankle", _HERE, _X, -0.397761, 0.768992, 4.16174, 3.348),
    ("LShoulderPitch", "torso", "LShoulder", _SHOULDER, _Y, -2.08567, 2.08567, 8.26797, 1.329),
    ("LShoulderRoll", "LShoulder", "LBicep", _HERE, _Z, -0.314159, 1.32645, 7.19407, 1.7835),
    ("LElbowYaw", "LBicep", "LElbow", _ELBOW, _X, -2.08567, 2.08567, 8.26797, 1.547),
    ("LElbowRoll", "LElbow", "LForeArm", _HERE, _Z, -1.54462, -0.0349066, 7.19407, 1.532),
    ("LWristYaw", "LForeArm", "l_wrist", _WRIST, _X, -1.82387, 1.82387, 24.6229, 0.4075),
    ("LHand", "l_wrist", "l_gripper", _HAND, _X, 0.0, 1.0, 8.33, 0.292),
)

PHALANX_LENGTH: Final = 0.01436
"""Finger joint to the next one [m]."""
_FINGER_RATIO: Final = 0.999899
"""Finger joint's angle per angle of the hand's motor, and a finger joint's curl when shut."""

# name, phalanges, and position and roll, pitch, yaw of its first joint in the wrist's frame
_FINGERS: Final = (
    ("Finger1", 3, (0.06907, 0.01157, -0.00304), (1.8862, 0.976662, 0.264067)),
    ("Finger2", 3, (0.06907, -0.01157, -0.00304), (1.25539, 0.976662, -0.264067)),
    ("Thumb", 2, (0.04895, 0.0, -0.02638), (-1.5708, 0.0472984, 0.0)),
)

# name, mass, centre of mass, inertia; lengths and moments as published
_MIDDLE_LINKS: Final = (
    ("torso", 1.04956, (-0.00413, 0.0, 0.04342),
     (3.08361e-3, 1.43116e-5, -3.30211e-5, 2.8835e-3, -2.70793e-5, 1.5924e-3)),
    ("Neck", 0.07842, (-1e-5, 0.0, -0.02742),
     (1.60324e-5, 1.57e-9, 3.16276e-9, 1.70394e-5, -5.295e-8, 5.53372e-6)),
    ("Head", 0.60533, (-0.00112, 0.0, 0.05258),
     (9.57766e-4, 8.78814e-6, 5.33702e-6, 8.16836e-4, -2.99579e-5, 9.84976e-4)),
)  # fmt: skip
_LEFT_LINKS: Final = (
    ("LPelvis", 0.06981, (-0.00781, -0.01114, 0.02661),
     (2.3407e-5, 1.07922e-6, -1.76003e-6, 4.76355e-5, 2.76058e-6, 4.97021e-5)),
    ("LHip", 0.14053, (-0.01549, 0.00029, -0.00515),
     (2.38445e-5, -6.53605e-7, 7.12893e-6, 6.08246e-5, -2.14072e-7, 5.43691e-5)),
    ("LThigh", 0.38968, (0.00138, 0.00221, -0.05373),
     (5.09844e-4, 2.11296e-6, 5.64129e-5, 4.65358e-4, -7.91029e-6, 3.01098e-4)),
    ("LTibia", 0.30142, (0.00453, 0.00225, -0.04936),
     (4.46171e-4, 3.70584e-6, -3.09008e-5, 3.88084e-4, 6.01953e-6, 1.85516e-4)),
    ("LAnklePitch", 0.13416, (0.00045, 0.00029, 0.00685),
     (3.22034e-5, -8.83212e-9, 4.27549e-6, 6.7943e-5, 2.84849e-7, 5.48269e-5)),
    ("l_ankle", 0.17184, (0.02542, 0.0033, -0.03239),
     (8.72911e-5, 8.71925e-6, -2.10563e-6, 3.53024e-4, 3.73459e-7, 4.12846e-4)),
    ("LShoulder", 0.09304, (-0.00165, -0.02663, 0.00014),
     (1.83025e-5, 2.06011e-6, 1.88776e-9, 1.39005e-5, -3.66592e-7, 2.01862e-5)),
    ("LBicep", 0.15777, (0.02455, 0.00563, 0.0033),
     (8.7181e-5, -2.53381e-5, -1.4213e-5, 2.74712e-4, 4.71439e-7, 2.41812e-4)),
    ("LElbow", 0.06483, (-0.02744, 0.0, -0.00014),
     (5.59588e-6, 4.21e-9, 2.92241e-7, 2.66179e-5, -1.84e-9, 2.76294e-5)),
    ("LForeArm", 0.07761, (0.02556, 0.00281, 0.00076),
     (2.46746e-5, 3.23152e-6, 1.58221e-6, 3.83837e-5, 1.39194e-7, 3.59708e-5)),
    ("l_wrist", 0.18533, (0.03434, -0.00088, 0.00308),
     (6.86477e-5, 1.15465e-7, -2.87254e-6, 1.35756e-4, 2.67539e-6, 1.33228e-4)),
)  # fmt: skip

# The documentation has the mass of a hand as a whole (l_wrist); its moving parts get token masses.
_TOKEN_MASS: Final = 2e-6
_TOKEN_INERTIA: Final = (1.1e-9, 0.0, 0.0, 1.1e-9, 0.0, 1.1e-9)


def _fingers(side: str) -> Iterator[Joint]:
    """Yield the eight finger joints of one hand, which are alike on both sides."""
    for finger, phalanges, origin, rpy in _FINGERS:
        for i in range(1, phalanges + 1):
            first = i == 1
            yield Joint(
                name=f"{side}{finger}{i}",
                parent=f"{side.lower()}_wrist" if first else f"{side}{finger}{i - 1}_link",
                child=f"{side}{finger}{i}_link",
                origin=origin if first else (PHALANX_LENGTH, 0.0, 0.0),
                rpy=rpy if first else (0.0, 0.0, -_FINGER_RATIO),
                axis=_Z,
                mimic=f"{side}Hand",
                mimic_ratio=_FINGER_RATIO,
            )


def _joint(
    name: str, parent: str, child: str, origin: Vector, axis: Vector,
    lower: float, upper: float, speed: float, effort: float,
) -> Joint:  # fmt: skip
    """Return a joint from a row of the tables above."""
    return Joint(
        name=name, parent=parent, child=child, origin=origin, axis=axis,
        lower=lower, upper=upper, speed=speed, effort=effort,
    )  # fmt: skip


def _right(joint: Joint) -> Joint:
    """Mirror a joint, with the published differences of the right side."""
    mirrored = mirrored_joint(joint)
    if mirrored.name == "RHipYawPitch":  # one motor turns both hips
        return replace(mirrored, mimic="LHipYawPitch")
    if mirrored.name == "RAnklePitch":
        return replace(mirrored, lower=-1.1863, upper=0.932006)
    if mirrored.name == "RHand":  # it opens by positive angles on both sides
        return replace(mirrored, lower=joint.lower, upper=joint.upper)
    return mirrored


def _all_joints() -> tuple[Joint, ...]:
    left = [_joint(*row) for row in _LEFT_JOINTS]
    return (
        *(_joint(*row) for row in _MIDDLE_JOINTS),
        *left,
        *(_right(joint) for joint in left),
        *_fingers("L"),
        *_fingers("R"),
    )


def _all_links() -> tuple[Link, ...]:
    def link(name: str, mass: float, com: Vector, inertia: Inertia) -> Link:
        return Link(name=name, mass=mass, com=com, inertia=inertia)

    left = [link(*row) for row in _LEFT_LINKS]
    weighed = [
        *(link(*row) for row in _MIDDLE_LINKS),
        *left,
        *(mirrored_link(body) for body in left),
    ]
    names = {body.name for body in weighed}
    tokens = [joint.child for joint in JOINTS.values() if joint.child not in names]
    return (*weighed, *(link(name, _TOKEN_MASS, _HERE, _TOKEN_INERTIA) for name in tokens))


JOINTS: Final = {joint.name: joint for joint in _all_joints()}
"""The 42 joints by name, parents first: 26 motors (two of them share one) and 16 in the fingers."""

LINKS: Final = {link.name: link for link in _all_links()}
"""The 43 bodies by name, the torso first."""
