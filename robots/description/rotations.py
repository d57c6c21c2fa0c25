"""Rotations in three dimensions, as matrices and as URDF's roll, pitch and yaw."""

from math import atan2, cos, hypot, sin

import numpy as np
from colift.robots.arithmetic import each, matmul
from colift.robots.description.parts import Vector
from numpy.typing import ArrayLike, NDArray


def about(axis: Vector, angle: ArrayLike) -> NDArray[np.float64]:
    """Return the rotation matrix about an axis, by Rodrigues' formula.

    Parameters
    ----------
    axis
        Axis of rotation; need not be of unit length.
    angle
        Angle [rad], of any shape ``S``.

    Returns
    -------
    NDArray
        ``I + sin(angle) K + (1 - cos(angle)) K^2``, ``K`` the cross-product matrix of the unit
        axis; of shape ``S + (3, 3)``.
    """
    length = hypot(*axis)
    x, y, z = (number / length for number in axis)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    angles = np.asarray(angle, dtype=np.float64)[..., None, None]
    turn: NDArray[np.float64] = (
        np.eye(3) + each(sin, angles) * cross + (1.0 - each(cos, angles)) * matmul(cross, cross)
    )
    return turn


def from_rpy(rpy: Vector) -> NDArray[np.float64]:
    """Return the matrix ``Rz(yaw) Ry(pitch) Rx(roll)`` of URDF's roll, pitch and yaw [rad]."""
    roll, pitch, yaw = rpy
    return matmul(matmul(about((0, 0, 1), yaw), about((0, 1, 0), pitch)), about((1, 0, 0), roll))


def to_rpy(rotation: NDArray[np.float64]) -> Vector:
    """Return URDF's roll, pitch and yaw [rad] of a rotation matrix (3, 3); pitch in +-pi/2."""
    pitch = atan2(-rotation[2, 0], hypot(rotation[0, 0], rotation[1, 0]))
    yaw = atan2(rotation[1, 0], rotation[0, 0])
    # Roll is what is left after yaw and pitch: defined even where the pitch is a right angle.
    roll = atan2(
        sin(yaw) * rotation[0, 2] - cos(yaw) * rotation[1, 2],
        cos(yaw) * rotation[1, 1] - sin(yaw) * rotation[0, 1],
    )
    return roll, pitch, yaw
