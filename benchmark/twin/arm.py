"""The NAO's arms on their one path: set-point, sag, lag and bend as functions of a height.

The joints follow the set-points on the path with one lag, so that they are at a weighted mean of
past points of the path. With the weighted mean and variance of the heights s of these points, the
hands are at

    mean(s) + bend(mean(s)) var(s),        bend = J . q'' / 2,

with the joints' angles q(s) and the hands' vertical Jacobian J: the path is a curve, and the joints
cut its corners.
"""

import math
from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.world.servo import SERVO
from colift.benchmark.world.table import WEIGHT_SHARE
from colift.robots.nao.kinematics import STROKE, arm_path

_DEGREE: Final = 7
"""Degree of the polynomials along the stroke: within 0.001 mm of the rows of the path."""

_MIDDLE: Final = (STROKE[0] + STROKE[1]) / 2
_HALF: Final = (STROKE[1] - STROKE[0]) / 2
_LAG: Final = SERVO.time
_YIELDING: Final = -math.expm1(-FRAME / SERVO.load_time)


def _along_the_stroke(rows: np.ndarray) -> tuple[float, ...]:
    """Return the coefficients, highest power first, of a polynomial through values on the path."""
    place = (arm_path().heights - _MIDDLE) / _HALF
    return tuple(float(c) for c in np.polyfit(place, rows, _DEGREE))


def _polynomial(coefficients: tuple[float, ...], place: jax.Array) -> jax.Array:
    value = jnp.full_like(place, coefficients[0])
    for coefficient in coefficients[1:]:
        value = value * place + coefficient
    return value


_WEIGHT_SAG: Final = _along_the_stroke(
    -(arm_path().levers * arm_path().gravity_torques / SERVO.stiffness).sum(axis=1)
)
_COMPLIANCE: Final = _along_the_stroke((arm_path().levers ** 2 / 2 / SERVO.stiffness).sum(axis=1))


_SPACING: Final = float(arm_path().heights[1] - arm_path().heights[0])
_SECOND: Final = np.gradient(
    np.gradient(np.array(arm_path().joints)[:, :5], _SPACING, axis=0), _SPACING, axis=0
)
_BEND: Final = _along_the_stroke((arm_path().levers * _SECOND / 2).sum(axis=1))


class ArmVariation(NamedTuple):
    """Variation of arms relative to the benchmark's, for which all factors are 1."""

    sag: jax.Array
    """(n,) factor of the sag by weight and load."""
    lag: jax.Array
    """(n,) factor of the joints' gain: below 1, the arms are slower."""
    load: jax.Array | float = 1.0
    """(n,) factor of the table's weight at rest, which an offset compensates."""


class Arm(NamedTuple):
    """The state of n pairs of arms."""

    hand: jax.Array
    """(n,) height of the hands [m]."""
    mean: jax.Array
    """(n,) mean of the heights on the path that the joints follow [m]."""
    variance: jax.Array
    """(n,) their variance [m2]."""
    target: jax.Array
    """(n,) set-point for the end of the last frame [m]."""
    load: jax.Array
    """(n,) filtered force that the hands bear [N]."""


def arms_at_rest(count: int, load: jax.Array | float = 1.0) -> Arm:
    """Return arms at rest under their share of the weight of tables, ``load`` times the usual."""
    zero = jnp.zeros(count)
    weight = jnp.full(count, WEIGHT_SHARE) * load
    return Arm(hand=zero, mean=zero, variance=zero, target=zero, load=weight)


def drive(
    arm: Arm, command: jax.Array, force: jax.Array, variation: ArmVariation | None = None
) -> Arm:
    """Return the arms a frame later, in one step; see :class:`.NaoArms` for the equations.

    Parameters
    ----------
    arm
        The arms.
    command
        (n,) commanded height at the end of the frame [m].
    force
        (n,) force of the hands on the table in the last frame [N].
    variation
        Variation of the arms; None is the benchmark's arms.
    """
    load, target = prepared(arm, command, force, variation)
    return followed(arm, target, variation=variation)._replace(target=target, load=load)


def prepared(
    arm: Arm, command: jax.Array, force: jax.Array, variation: ArmVariation | None = None
) -> tuple[jax.Array, jax.Array]:
    """Return the load [N] and the set-point for the end of a frame [m], each (n,); see `drive`."""
    load = arm.load + _YIELDING * (force - arm.load)
    place = (command - _MIDDLE) / _HALF
    sag = _sag(place, load)
    # At rest, the offset compensates for the sag under the table's weight.
    rest_place = jnp.full_like(command, -_MIDDLE / _HALF)
    weight = WEIGHT_SHARE * (1.0 if variation is None else variation.load)
    sag = sag - _sag(rest_place, jnp.full_like(load, 1.0) * weight)
    if variation is not None:
        sag = sag * variation.sag
    return load, _nearest_row(jnp.clip(command - sag, *STROKE))


def followed(
    arm: Arm,
    target: jax.Array,
    begin: float | jax.Array = 0.0,
    step: float = FRAME,
    variation: ArmVariation | None = None,
) -> Arm:
    """Return the arms a physics step later; the set-point of the last frame is kept.

    Parameters
    ----------
    arm, variation
        As for :func:`drive`.
    target
        (n,) set-point for the end of the frame [m].
    begin
        Beginning of the step, as a fraction of the frame.
    step
        Its duration [s].
    """
    gains = jnp.full_like(arm.load, -math.expm1(-step / _LAG))
    lag: jax.Array | float = _LAG
    if variation is not None:
        gains = gains * variation.lag
        lag = -step / jnp.log1p(-gains)
    ahead = (step / gains - lag) / FRAME
    on_the_way = _nearest_row(arm.target + (target - arm.target) * (begin + ahead))
    off = on_the_way - arm.mean
    mean = arm.mean + gains * off
    variance = (1 - gains) * (arm.variance + gains * off**2)
    bend = _polynomial(_BEND, (mean - _MIDDLE) / _HALF)
    return arm._replace(hand=mean + bend * variance, mean=mean, variance=variance)


def _nearest_row(height: jax.Array) -> jax.Array:
    """Return the height of the nearest row of the path, with the gradient of the height itself."""
    row = STROKE[0] + _SPACING * jnp.floor((height - STROKE[0]) / _SPACING + 0.5)
    return height + jax.lax.stop_gradient(row - height)


def _sag(place: jax.Array, load: jax.Array) -> jax.Array:
    return _polynomial(_WEIGHT_SAG, place) + _polynomial(_COMPLIANCE, place) * load
