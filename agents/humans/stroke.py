"""Point-to-point hand movements: skewed strokes, submovements, re-planning.

A *motion* is an array ``(3, frames)``: displacement [m], velocity [m/s] and acceleration [m/s^2]
at the ends of the motion's frames, at ``FRAME, 2 FRAME, ...``; its start, at time 0, is the last
frame of the preceding motion.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from colift.agents.agent import FRAME
from numpy.typing import NDArray

Motion = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Submovement:
    """One minimum-jerk piece of a movement.

    With ``tau`` the relative time, the piece follows ``rise`` times the minimum-jerk
    profile at the warped time ``w = tau / (r + (1 - r) tau)``. The speed is highest at
    ``tau = skew`` when ``r = skew (2 - skew) / (1 - skew^2)``; ``skew = 0.5`` is the plain
    minimum-jerk movement.
    """

    start: float
    """Onset [s] from the start of the motion."""
    duration: float
    """[s]"""
    rise: float
    """Displacement [m] that the piece adds, up positive."""
    skew: float = 0.5
    """Relative time of the highest speed, between 0 and 1."""


def superpose(pieces: Sequence[Submovement], frames: int) -> Motion:
    """Return the sum of the pieces as a motion of that many frames.

    Notes
    -----
    Movements contain overlapping submovements with bell-shaped speeds: Novak, Miller and Houk, "The
    use of overlapping submovements in the control of rapid hand movements", Exp. Brain Res. 144
    (2002).
    """
    table = np.array([(p.start, p.duration, p.rise, p.skew) for p in pieces])
    start, duration, rise, skew = table.T[:, :, np.newaxis]
    time = FRAME * np.arange(1, frames + 1)
    tau = np.minimum(np.maximum((time - start) / duration, 0.0), 1.0)
    r = skew * (2.0 - skew) / (1.0 - skew * skew)
    scale = 1.0 / (r + (1.0 - r) * tau)
    w = tau * scale
    dw = r * scale * scale / duration
    ddw = (-2.0 * (1.0 - r) / duration) * dw * scale
    bell = w * (1.0 - w)
    slope = 30.0 * bell * bell
    motion = np.empty((3, frames))
    motion[0] = (rise * w * w * w * (10.0 + w * (6.0 * w - 15.0))).sum(axis=0)
    motion[1] = (rise * slope * dw).sum(axis=0)
    motion[2] = (rise * (60.0 * bell * (1.0 - 2.0 * w) * dw * dw + slope * ddw)).sum(axis=0)
    return motion


def stroke(
    rise: float, duration: float, *, skew: float = 0.5, extra: Sequence[Submovement] = ()
) -> Motion:
    """Return a movement from rest to rest over ``rise`` [m] in ``duration`` [s].

    The base movement covers the rest of the displacement: with the ``extra`` submovements, the
    sum ends at ``rise``. The duration is rounded to whole frames; the extras must end within it.
    """
    frames = max(round(duration / FRAME), 1)
    rest = rise - math.fsum(piece.rise for piece in extra)
    base = Submovement(start=0.0, duration=frames * FRAME, rise=rest, skew=skew)
    return superpose((base, *extra), frames)


def replan(state: Sequence[float] | NDArray[np.float64], goal: float, duration: float) -> Motion:
    """Return the movement from a moving state to rest at ``goal``.

    The quintic that matches position, velocity and acceleration at both ends is the
    minimum-jerk movement between them. Here the displacement is absolute: it starts at
    ``state[0]`` and ends at ``goal``.

    Parameters
    ----------
    state
        Position [m], velocity [m/s] and acceleration [m/s^2] at time 0.
    goal
        Position at the end [m].
    duration
        Duration [s], rounded to whole frames.
    """
    frames = max(round(duration / FRAME), 1)
    total = frames * FRAME
    position, velocity, acceleration = (float(value) for value in state)
    gap = goal - position
    v = velocity * total
    a = 0.5 * acceleration * total * total
    c3 = 10.0 * gap - 6.0 * v - 3.0 * a
    c4 = -15.0 * gap + 8.0 * v + 3.0 * a
    c5 = 6.0 * gap - 3.0 * v - a
    t = np.arange(1, frames + 1) / frames
    motion = np.empty((3, frames))
    motion[0] = position + t * (v + t * (a + t * (c3 + t * (c4 + t * c5))))
    motion[1] = (v + t * (2 * a + t * (3 * c3 + t * (4 * c4 + t * (5 * c5))))) / total
    motion[2] = (2 * a + t * (6 * c3 + t * (12 * c4 + t * (20 * c5)))) / (total * total)
    return motion
