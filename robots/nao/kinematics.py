"""Kinematics and statics of NAO's arms, and the one path on which its hands lift the table.

Everything is given for the left arm in the torso's frame (x forward, y left, z up); the right arm
is its mirror image. Joint angles are in the order of ``facts.ARM``.
"""

import cmath
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from math import acos, atan2, hypot, pi
from typing import Final

import numpy as np
from colift.robots.arithmetic import dot, matmul
from colift.robots.description import rotations
from colift.robots.nao.facts import (
    ARM,
    ELBOW_OFFSET_Y,
    HAND_OFFSET_X,
    HAND_OFFSET_Z,
    JOINTS,
    LINKS,
    LOWER_ARM_LENGTH,
    SHOULDER_OFFSET_Y,
    SHOULDER_OFFSET_Z,
    UPPER_ARM_LENGTH,
)
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

ARM_JOINTS: Final = tuple(f"{side}{joint}" for side in "LR" for joint in ARM)
"""Names of the ten arm joints: the left arm's five from the shoulder outwards, then the right's."""

MIRROR: Final = (1.0, -1.0, -1.0, -1.0, -1.0)
"""Sign of a right joint's angle for the mirror image of the left's: pitch stays, roll and yaw turn.

Levers and torques of the right arm follow the same signs.
"""

GRIP_X: Final = 0.133
"""Distance of the hands in front of the torso's origin [m]."""
GRIP_Y: Final = 0.050
"""Distance of each hand from the middle plane [m]. The hands are closer together than the shoulders
(0.098 m): the elbow bends to 88.5 degrees only, which leaves 0.139 to 0.220 m between shoulder and
hand, and at shoulder height a hand straight ahead of the shoulder would be too near.
"""
REST_Z: Final = -0.030
"""Height of the hands above the torso's origin [m] at displacement 0, the table's rest."""
STROKE: Final = (-0.030, 0.290)
"""Lowest and highest displacement of the hands [m]."""

_ROW: Final = 5e-5
_LAST_ROW: Final = round((STROKE[1] - STROKE[0]) / _ROW)
_GRAVITY: Final = 9.81


def _frames(joints: Array) -> Iterator[tuple[Array, Array, Array]]:
    """Yield position (..., 3), rotation (..., 3, 3) and axis (..., 3) of each joint's frame."""
    position = np.zeros(3)
    rotation = np.eye(3)
    for index, name in enumerate(ARM):
        joint = JOINTS[f"L{name}"]
        position = position + dot(rotation, np.array(joint.origin))
        axis = dot(rotation, np.array(joint.axis))
        rotation = matmul(rotation, rotations.about(joint.axis, joints[..., index]))
        yield position, rotation, axis


def _lever(point: Array, position: Array, axis: Array) -> Array:
    """Return dz/dq [m] of a point turned about an axis through ``position``: the z of a x r."""
    arm = point - position
    product: Array = axis[..., 0] * arm[..., 1] - axis[..., 1] * arm[..., 0]
    return product


def hand_position(joints: ArrayLike) -> Array:
    """Return the position of the left hand point (the end of HandOffset) in the torso's frame [m].

    Parameters
    ----------
    joints
        Left arm's joint angles [rad], shape (..., 5).

    Returns
    -------
    NDArray
        x, y, z of shape (..., 3). The right hand's, for angles ``MIRROR * joints``, has -y.
    """
    *_, (position, rotation, _) = _frames(np.asarray(joints, dtype=np.float64))
    hand: Array = position + dot(rotation, np.array(JOINTS["LHand"].origin))
    return hand


def joint_positions(joints: ArrayLike) -> Array:
    """Return the positions of the left arm's five joints in the torso's frame [m], (..., 5, 3).

    ``joints`` are its angles [rad], shape (..., 5). Shoulder pitch and roll are in one place, elbow
    yaw and roll in another; the last is the wrist.
    """
    angles = np.asarray(joints, dtype=np.float64)
    places = [position for position, _, _ in _frames(angles)]
    return np.stack([np.broadcast_to(at, (*angles.shape[:-1], 3)) for at in places], axis=-2)


def vertical_lever(joints: ArrayLike) -> Array:
    """Return the hand's vertical Jacobian row dz/dq [m/rad] of the left arm, shape (..., 5).

    A vertical force F [N] on the hand, upwards positive, loads joint i with F dz/dq_i [N m].
    """
    angles = np.asarray(joints, dtype=np.float64)
    hand = hand_position(angles)
    return np.stack([_lever(hand, at, axis) for at, _, axis in _frames(angles)], axis=-1)


def gravity_torque(joints: ArrayLike) -> Array:
    """Return the torque [N m] of the left arm's own weight on its joints, shape (..., 5).

    Joint i feels ``-g sum_k m_k dz_k/dq_i`` over the links k beyond it, z_k the height of their
    centres of mass, the torso upright; holding the arm still takes the opposite. The token masses
    of the fingers (2e-5 kg) are left out.
    """
    angles = np.asarray(joints, dtype=np.float64)
    frames = list(_frames(angles))
    torque = np.zeros(angles.shape)
    for outer, (position, rotation, _) in enumerate(frames):
        link = LINKS[JOINTS[f"L{ARM[outer]}"].child]
        com = position + dot(rotation, np.array(link.com))
        for inner, (pivot, _, axis) in enumerate(frames[: outer + 1]):
            torque[..., inner] -= _GRAVITY * link.mass * _lever(com, pivot, axis)
    return torque


def lifting_angles(z: ArrayLike) -> Array:
    """Return the left arm's angles [rad] that put the hand at (GRIP_X, GRIP_Y, z), shape (..., 5).

    Two of the arm's five angles can be chosen freely. With the elbow's yaw at 0 and the wrist's at
    -pi/2 the whole arm lies in one plane, which the shoulder's pitch tilts towards the hand, and in
    it roll and elbow are a planar two-link arm: closed form, symmetric about shoulder height, palms
    inwards. A numerical search over polynomial elbow and wrist yaws reduced the mean square joint
    rate by only 4 %.

    Parameters
    ----------
    z
        Height of the hand in the torso's frame [m], any shape.

    Notes
    -----
    With u shoulder to elbow and v elbow to hand in the plane, and (d, e) the hand there,
    ``d^2 + e^2 = |u|^2 + |v|^2 + 2 |u| |v| cos(bend)``; NAO's elbow bends inwards only.
    """
    rise = np.asarray(z, dtype=np.float64) - SHOULDER_OFFSET_Z
    angles = [_lifting_angles(each) for each in rise.ravel().tolist()]
    return np.array(angles).reshape(*rise.shape, len(ARM))


def _lifting_angles(rise: float) -> list[float]:
    """Return the angles [rad] for a hand ``rise`` above the shoulder [m]."""
    ahead, aside = hypot(GRIP_X, rise), GRIP_Y - SHOULDER_OFFSET_Y
    upper = complex(UPPER_ARM_LENGTH, ELBOW_OFFSET_Y)
    lower = complex(LOWER_ARM_LENGTH + HAND_OFFSET_X, -HAND_OFFSET_Z)
    square = ahead**2 + aside**2 - abs(upper) ** 2 - abs(lower) ** 2
    bend = acos(square / (2 * abs(upper) * abs(lower)))
    elbow_roll = cmath.phase(upper) - cmath.phase(lower) - bend
    straight = upper + lower * cmath.rect(1.0, elbow_roll)
    shoulder_roll = cmath.phase(complex(ahead, aside) / straight)
    return [-atan2(rise, GRIP_X), shoulder_roll, 0.0, elbow_roll, -pi / 2]


@dataclass(frozen=True, kw_only=True)
class ArmPath:
    """The arms along the stroke, looked up by the hands' height; made by ``arm_path()``.

    Rows are 0.05 mm of height apart; a height in between uses the nearer row, a height outside
    ``STROKE`` the last one. The arrays are read-only.
    """

    heights: Array
    """Displacement of the hands [m] in each row, shape (n,)."""
    joints: tuple[list[float], ...]
    """The angles of ``ARM_JOINTS`` [rad] in each row: n lists of ten."""
    levers: Array
    """``vertical_lever`` of the left arm [m/rad] in each row, shape (n, 5)."""
    gravity_torques: Array
    """``gravity_torque`` of the left arm [N m] in each row, shape (n, 5)."""

    def row(self, height: float) -> int:
        """Return the row of a height [m]."""
        index = int((height - STROKE[0]) / _ROW + 0.5)
        return 0 if index < 0 else _LAST_ROW if index > _LAST_ROW else index

    def joint_angles(self, height: float) -> list[float]:
        """Return the angles of ``ARM_JOINTS`` [rad] that put both hands at a height [m]."""
        return self.joints[self.row(height)].copy()

    def lever(self, height: float) -> Array:
        """Return dz/dq [m/rad] of the left arm's five joints at a height [m]."""
        lever: Array = self.levers[self.row(height)]
        return lever

    def gravity_torque(self, height: float) -> Array:
        """Return the torque [N m] of the left arm's weight on its five joints at a height [m]."""
        torque: Array = self.gravity_torques[self.row(height)]
        return torque


@cache
def arm_path() -> ArmPath:
    """Return the path of the arms, built at the first call."""
    low, high = STROKE
    heights = np.linspace(low, high, _LAST_ROW + 1)
    left = lifting_angles(REST_Z + heights)
    levers, torques = vertical_lever(left), gravity_torque(left)
    for array in (heights, levers, torques):
        array.flags.writeable = False
    return ArmPath(
        heights=heights,
        joints=tuple(np.concatenate([left, np.array(MIRROR) * left], axis=1).tolist()),
        levers=levers,
        gravity_torques=torques,
    )
