"""Adaptive impedance around a planned motion: learned by practice, scaled by the plan's certainty.

A spring of stiffness K draws the hand to its plan; the table draws it to its partner. K is relative
to the table's stiffness: with 0 the hand follows the partner, with 1 both have equal weight.
"""

import math
from dataclasses import dataclass, replace
from typing import Final, NamedTuple

import numpy as np
from colift.base.errors import InputError
from numpy.typing import NDArray

Array = NDArray[np.float64]

STIFFEST: Final = 20.0
"""Largest stiffness: the hand then corrects less than a twentieth of a deviation per period."""


def certainty(variance: float, tolerance: float) -> float:
    """Return the certainty of a plan, in (0, 1]: t^2 / (t^2 + s^2).

    Parameters
    ----------
    variance
        s^2, variance of the prediction that the plan is for [m2].
    tolerance
        t, the standard deviation at which the certainty is one half [m].
    """
    return tolerance**2 / (tolerance**2 + variance)


def compliance(stiffness: float) -> float:
    """Return the fraction of a deviation from the plan that the hand corrects: 1 / (1 + K).

    At that fraction the spring to the plan and the table's spring to the partner are in balance.
    """
    return 1.0 / (1.0 + stiffness)


class Surprise:
    """Mean normalised squared error of predictions, 1 for a correct model.

    The normalised squared errors nu = e^2 / s^2, with exponential forgetting:

        lambda' = lambda + (1 - exp(-dt / T)) (min(nu, limit) - lambda)

    For a constant nu within the limit, lambda tends to nu; for a correct model, to E[nu] = 1
    (slightly less where nu is clipped to the limit).

    Parameters
    ----------
    memory
        T [s].
    limit
        Largest nu that counts, to bound the effect of an outlier.
    """

    def __init__(self, memory: float, limit: float) -> None:
        self._memory, self._limit = memory, limit
        self.value = 1.0

    def update(self, error: float, variance: float, elapsed: float) -> float:
        """Add an error [m] of a prediction of a variance [m2], ``elapsed`` [s] after the last.

        Returns
        -------
        float
            lambda.
        """
        gain = -math.expm1(-elapsed / self._memory)
        self.value += gain * (min(error**2 / variance, self._limit) - self.value)
        return self.value


@dataclass(frozen=True, kw_only=True, eq=False)
class LearnedImpedance:
    """Stiffness around the plan and feed-forward terms, as learned by practice."""

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
    """One action and its parts."""

    change: float
    """Change of the command [m]."""
    deviation: float
    """d, plan minus command before the action [m]."""
    correction: float
    """kappa, the fraction of d that was corrected."""
    velocity: float
    """v, planned velocity at the end of the action [m/s]."""
    weights: Array
    """(k,) w, weight of the stiffness of each situation: responsibility times certainty."""


@dataclass(frozen=True, kw_only=True)
class Gains:
    """Gains of :func:`adapt`."""

    stiffness: float = 0.2
    """eta_K."""
    effort: float = 0.5
    """rho: cost of the robot's own correction, relative to a height difference of its size. At 0
    the error alone counts, and the hand is restless."""
    lead: float = 0.2
    """eta_T [s2/m2]."""
    offset: float = 0.002
    """eta_z."""


def adapt(
    impedance: LearnedImpedance, movement: Movement, error: float, tolerance: float, gains: Gains
) -> LearnedImpedance:
    """Return the impedance after one more movement of practice.

    The error e is the height difference, human minus robot, that remained after the movement.

        K_i'  = K_i - eta_K w_i (e d - rho kappa d^2) / t^2,  clipped to [0, STIFFEST]
        lead' = lead + eta_T e v,    offset' = offset + eta_z e

    The first update descends the cost E[e^2 + rho (kappa d)^2]: if too little of a deviation was
    corrected, an error of its sign remains and the hand becomes more compliant; if too much, it
    becomes stiffer. The fixed point is E[w_i d (e - rho kappa d)] = 0, at the fraction
    kappa* / (1 + rho), with kappa* the least-squares fraction of d that levels the table. As in
    human motor learning, stiffness and feed-forward adapt to the error against the effort (Yang,
    Ganesh, Haddadin, Parusel, Albu-Schaeffer, Burdet 2011). Lead and offset settle where the error
    has zero mean and is uncorrelated with the velocity.
    """
    d = movement.deviation
    downhill = d * (error - gains.effort * movement.correction * d) / tolerance**2
    stiffness = impedance.stiffness - gains.stiffness * movement.weights * downhill
    return replace(
        impedance,
        stiffness=np.clip(stiffness, 0.0, STIFFEST),
        lead=impedance.lead + gains.lead * error * movement.velocity,
        offset=impedance.offset + gains.offset * error,
    )
