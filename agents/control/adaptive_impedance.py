"""An impedance around a planned motion, which adapts: in practice, and to how well the plan holds.

The hand is held to its plan by a spring of stiffness K, and drawn towards its partner by the
table. K is relative to the table's stiffness: with 0 the hand goes wherever the partner does, with
1 both weigh the same.
"""

import math
from dataclasses import dataclass, replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError

Array = NDArray[np.float64]

STIFFEST: Final = 20.0
"""Largest stiffness: of a discrepancy the hand then takes up less than a twentieth in a period."""


def certainty(variance: float, tolerance: float) -> float:
    """Return how certain a plan is, in (0, 1]: t^2 / (t^2 + s^2).

    Parameters
    ----------
    variance
        s^2, variance of what was planned for [m2].
    tolerance
        t, the deviation at which the plan is half certain [m].
    """
    return tolerance**2 / (tolerance**2 + variance)


def yielding(stiffness: float) -> float:
    """Return the share of a deviation from the plan that the hand takes up: 1 / (1 + K).

    This is where the spring to the plan and the table's spring to the partner are in balance.
    """
    return 1.0 / (1.0 + stiffness)


class Surprise:
    """How far off predictions are, relative to their own variance: 1 for a model that holds.

    The normalised squared errors nu = e^2 / s^2, forgotten exponentially:

        lambda' = lambda + (1 - exp(-dt / T)) (min(nu, limit) - lambda)

    For a constant nu within the limit, lambda tends to nu; for a model that holds, to E[nu] = 1
    (a little less where the limit cuts).

    Parameters
    ----------
    memory
        T [s].
    limit
        Largest nu that counts: one outlier shall not be remembered long.
    """

    def __init__(self, memory: float, limit: float) -> None:
        self._memory, self._limit = memory, limit
        self.value = 1.0

    def update(self, error: float, variance: float, elapsed: float) -> float:
        """Take in an error [m] of a prediction of a variance [m2], ``elapsed`` [s] after the last.

        Returns
        -------
        float
            lambda.
        """
        share = -math.expm1(-elapsed / self._memory)
        self.value += share * (min(error**2 / variance, self._limit) - self.value)
        return self.value


@dataclass(frozen=True, kw_only=True, eq=False)
class Impedance:
    """What is learned by practice: how stiffly to hold to the plan, and what to feed forward."""

    stiffness: Array
    """(k,) K in each situation, relative to the table's stiffness, in [0, ``STIFFEST``]."""
    lead: float
    """Time by which the command runs ahead of the plan [s]: the arm follows it late."""
    offset: float
    """Height by which the command is above the plan [m]: the arm sags."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If a stiffness is out of its range, or a number is not finite.
        """
        if not ((self.stiffness >= 0) & (self.stiffness <= STIFFEST)).all():
            raise InputError(
                f"stiffness must be in [0, {STIFFEST:g}], got {self.stiffness.tolist()}"
            )
        for name in ("lead", "offset"):
            if not math.isfinite(getattr(self, name)):
                raise InputError(f"{name} must be finite, got {getattr(self, name)}")


class Movement(NamedTuple):
    """What one action was made of."""

    change: float
    """Change of the command [m]."""
    deviation: float
    """d, how far the command was from the plan before [m]."""
    share: float
    """kappa, the share of it that was taken up."""
    velocity: float
    """v, planned velocity at the end of the action [m/s]."""
    weights: Array
    """(k,) how much the stiffness of each situation counted: responsibility times certainty."""


@dataclass(frozen=True, kw_only=True)
class Gains:
    """Gains of :func:`adapt`."""

    stiffness: float = 0.2
    """eta_K."""
    effort: float = 0.5
    """rho: what the robot's own correction costs, relative to a height difference of its size. At 0
    the error alone counts, and the hand is restless."""
    lead: float = 0.2
    """eta_T [s2/m2]."""
    offset: float = 0.002
    """eta_z."""


def adapt(
    impedance: Impedance, movement: Movement, error: float, tolerance: float, gains: Gains
) -> Impedance:
    """Return the impedance after one more experience.

    The error e is what remained of the height difference, human minus robot, after the movement.

        K_i'  = K_i - eta_K w_i (e d - rho kappa d^2) / t^2,  held to [0, STIFFEST]
        lead' = lead + eta_T e v,    offset' = offset + eta_z e

    The first descends the cost E[e^2 + rho (kappa d)^2]: a deviation that was taken up too
    little leaves an error of its own sign, and the hand gets more compliant; one that was taken up
    too much gets it stiffer. It rests where E[w_i d (e - rho kappa d)] = 0: at the share
    kappa* / (1 + rho), with kappa* the least-squares share of d in what d was to make up for. As in
    human motor learning, stiffness and feed-forward adapt to the error against the effort (Yang,
    Ganesh, Haddadin, Parusel, Albu-Schaeffer, Burdet 2011). The others rest where the error has no
    mean and does not grow with the speed.
    """
    d = movement.deviation
    downhill = d * (error - gains.effort * movement.share * d) / tolerance**2
    stiffness = impedance.stiffness - gains.stiffness * movement.weights * downhill
    return replace(
        impedance,
        stiffness=np.clip(stiffness, 0.0, STIFFEST),
        lead=impedance.lead + gains.lead * error * movement.velocity,
        offset=impedance.offset + gains.offset * error,
    )
