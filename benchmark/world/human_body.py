"""The human's body: arm impedance towards a reference, and delayed reflexes."""

import math
from dataclasses import dataclass
from typing import Final

from colift.agents.agent import FRAME
from colift.benchmark.world.interface import HISTORY_FRAMES
from colift.benchmark.world.table import GRIP_STIFFNESS, TABLE_LENGTH, WEIGHT_SHARE

REFLEX_LIMIT: Final = 0.02
"""Largest shift of the reference by a reflex [m]: reflexes correct small differences and do not
overrule the intended height."""

MUSCLE_TIME: Final = 0.05
"""Time constant of muscle activation [s], a first-order low-pass on the reflex."""


@dataclass(frozen=True, kw_only=True)
class BodyParameters:
    """The mechanical parameters of a person: impedance, mass, reflexes.

    Raises
    ------
    ValueError
        If a delay is negative or longer than the kept history, or mass or stiffness is not
        positive.
    """

    stiffness: float
    """K of the arm's endpoint [N/m]."""
    damping: float
    """B of the arm's endpoint [N s/m]."""
    mass: float
    """M, the arm's apparent mass at the hand [kg]."""
    pull: float
    """Fraction of a height difference that the reflexes counteract; 0 ignores it."""
    felt_share: float = 0.5
    """Fraction of the pull that comes from the felt force; the rest comes from sight."""
    visual_delay: float
    """Delay of sight [s]."""
    haptic_delay: float
    """Delay of touch [s]."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        longest = HISTORY_FRAMES * FRAME
        for name in ("visual_delay", "haptic_delay"):
            delay = getattr(self, name)
            if not 0 <= delay <= longest:
                raise ValueError(f"{name} must be in [0, {longest}] s, got {delay}")
        if self.mass <= 0 or self.stiffness <= 0 or self.damping < 0:
            raise ValueError(f"mass and stiffness must be positive, got {self}")


class HumanBody:
    """One person's arms on one end of the table.

    The arms pull their end towards a reference ``r`` (an equilibrium trajectory) as an impedance,

        F = K (r + reflex - z) + B (r' - z') + W,

    with the person's share ``W`` of the table's weight fed forward; the weight of the arms
    themselves is held by the person. The reflex follows, low-passed, from the felt force
    ``haptic_delay`` ago and from the seen height difference ``visual_delay`` ago: a steady height
    difference d shifts the reference by ``pull`` d.
    """

    __slots__ = (
        "_felt",
        "_gain_height",
        "_gain_velocity",
        "_haptic_gain",
        "_reflex",
        "_seen",
        "_smoothing",
        "_visual_gain",
        "_weight",
    )

    def __init__(
        self, parameters: BodyParameters, step: float, weight: float = WEIGHT_SHARE
    ) -> None:
        """Prepare the gains for a physics step of ``step`` [s], and a share ``weight`` [N].

        The engine's velocities are those of mid-step; evaluating the damper there too (as the mean
        of the velocities before and after the step) makes the step second-order accurate.
        """
        implicit = 1 + step * parameters.damping / parameters.mass / 2
        self._gain_height = parameters.stiffness / implicit
        self._gain_velocity = parameters.damping / implicit
        self._seen = -1 - round(parameters.visual_delay / FRAME)
        self._felt = -1 - round(parameters.haptic_delay / FRAME)
        felt = parameters.felt_share * parameters.pull
        self._visual_gain = parameters.pull - felt
        self._haptic_gain = felt * TABLE_LENGTH**2 / GRIP_STIFFNESS
        self._smoothing = -math.expm1(-FRAME / MUSCLE_TIME)
        self._weight = weight
        self._reflex = 0.0

    def reset(self) -> None:
        """Relax: no reflex is active."""
        self._reflex = 0.0

    def reflex(self, own: list[float], other: list[float], force: list[float]) -> float:
        """Advance the reflex by one frame and return its shift of the reference [m].

        Parameters
        ----------
        own, other, force
            Histories, newest last: heights of the person's and of the other end [m], and the force
            of the hands on the table [N].
        """
        wanted = self._visual_gain * (other[self._seen] - own[self._seen])
        wanted -= self._haptic_gain * (force[self._felt] - self._weight)
        if wanted > REFLEX_LIMIT:
            wanted = REFLEX_LIMIT
        elif wanted < -REFLEX_LIMIT:
            wanted = -REFLEX_LIMIT
        self._reflex += self._smoothing * (wanted - self._reflex)
        return self._reflex

    def arm_force(self, reference: float, rate: float, height: float, velocity: float) -> float:
        """Return the upward force of the arms [N] over the next physics step.

        Parameters
        ----------
        reference, rate
            Reference at the beginning of the step [m] and its rate [m/s], reflex included.
        height, velocity
            Height and velocity of the hands at the beginning of the step [m, m/s].
        """
        return (
            self._gain_height * (reference - height)
            + self._gain_velocity * (rate - velocity)
            + self._weight
        )
