"""Following by variable impedance: the approach that the paper starts from (section I).

In this tradition the robot moves like a virtual mass that the human drags, with a damping that
depends on the human's motion: K. Kosuge, H. Yoshida, T. Fukuda, "Dynamic control for robot-human
collaboration", RO-MAN 1993; R. Ikeura, H. Inooka, "Variable impedance control of a robot for
cooperation with a human", ICRA 1995; V. Duchaine, C. Gosselin, "General model of human-robot
cooperation using a novel velocity based variable impedance control", World Haptics 2007.

This file follows the paper's description, and the abstracts of the last two; the full texts were
not available to us. A follower of this kind measures the force between human and robot. The paper's
set-up cannot: here a virtual spring turns the seen height difference into a force. The damping law
is ours.
"""

import cmath
import math
from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.base.errors import InputError


@dataclass(frozen=True, kw_only=True)
class ImpedanceParameters:
    """Parameters of :class:`Impedance`. Only ratios matter, since the force is virtual.

    Tuned by random search on seed 5000 of ``standard-v1``, then on a grid on 5000 to 5004 (seeds of
    no suite): the least RMSE among those whose motion is as smooth (SPARC) as that of ``copy``,
    with the still damping fixed at critical. ``colift run impedance --seeds 5000:5005``
    gives 18.9 mm and -1.80, ``copy`` 21.2 mm and -1.82.
    """

    mass: float = 1.0
    """M of the virtual mass [kg]; sets the unit of force."""
    stiffness: float = 64.0
    """K of the spring between the human's end and the mass [N/m]: 8 rad/s with the mass."""
    still_damping: float = 16.0
    """D while the human is still [N s/m]: critical, which brings the mass to rest."""
    moving_damping: float = 0.5
    """D while the human moves [N s/m]: a thirtieth of critical, for little drag."""
    speed_scale: float = 0.02
    """Speed of the human's end at which D has fallen by a fraction 1 - 1/e [m/s]. The difference
    of two samples 0.1 s apart has a noise of 0.003 m/s."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If a parameter is not a positive number.
        """
        for name, value in vars(self).items():
            if not 0 < value < math.inf:
                raise InputError(f"{name} must be a positive number, got {value}")


IMPEDANCE_PARAMETERS = ImpedanceParameters()


def damping_at(speed: float, parameters: ImpedanceParameters = IMPEDANCE_PARAMETERS) -> float:
    """Return the damping [N s/m] for a speed v of the human's end [m/s].

    D(v) = D_moving + (D_still - D_moving) exp(-(v / v_s)^2)
    """
    still = math.exp(-((speed / parameters.speed_scale) ** 2))
    return still * parameters.still_damping + (1 - still) * parameters.moving_damping


def advance(
    offset: float,
    velocity: float,
    damping: float,
    period: float,
    parameters: ImpedanceParameters = IMPEDANCE_PARAMETERS,
) -> tuple[float, float]:
    """Return offset [m] and velocity [m/s] of the mass ``period`` [s] later.

    The exact solution of M x'' + D x' + K x = 0, with x the offset from the relaxed spring.
    With the roots r, s of M r^2 + D r + K = 0 and g = (exp(r t) - exp(s t)) / (r - s),
    which is t exp(r t) for equal roots:

        x(t) = exp(r t) x + g (x' - r x)
        x'(t) = exp(r t) x' + g (x'' - r x')

    For any period the energy of the mass and its spring decreases.
    """
    acceleration = -(parameters.stiffness * offset + damping * velocity) / parameters.mass
    middle = -damping / (2 * parameters.mass)
    half = cmath.sqrt(middle**2 - parameters.stiffness / parameters.mass)
    root = middle + half
    growth = cmath.exp(root * period)
    quotient = growth * (-np.expm1(-2 * half * period) / (2 * half) if half else period)
    offset_then = growth * offset + quotient * (velocity - root * offset)
    velocity_then = growth * velocity + quotient * (acceleration - root * velocity)
    return float(offset_then.real), float(velocity_then.real)


class Impedance:
    """Follows like a mass on a spring, damped less as the human moves (after Ikeura, Inooka 1995).

    The command x moves by M x'' + D(v) x' = K (z1 - x), with the height z1 and the speed v of the
    human's end as last seen, held over the period. D >= D_moving > 0 makes it passive: with the
    human still, it comes to rest. Behind a human of steady speed v it lags by
    v (latency + period / 2 + D(v) / K), once the onset is over.

    The robot's end is represented by the command, not by its seen height: with a height as old as
    the human's, the loop would contain the latency and not be passive. The sag of the hand under
    the table, 1 to 3 mm, therefore remains.
    """

    def __init__(self, *, parameters: ImpedanceParameters | None = None) -> None:
        self._parameters = parameters or IMPEDANCE_PARAMETERS

    def reset(self, seed: int) -> None:
        """Begin an episode at rest."""
        self._velocity = 0.0
        self._last: tuple[float, float] | None = None

    def act(self, observation: Observation) -> Action:
        """Return the displacement of the mass in this period [m]."""
        human = float(observation[RobotObservation.HUMAN_END])
        time = float(observation[RobotObservation.TIME])
        before, since = self._last or (human, time - DEFAULT_PERIOD)
        self._last = human, time
        period = time - since
        speed = abs(human - before) / period
        damping = damping_at(speed, self._parameters)
        offset = float(observation[RobotObservation.HAND_COMMAND]) - human
        offset_then, self._velocity = advance(
            offset, self._velocity, damping, period, self._parameters
        )
        self._internals = {
            "velocity": self._velocity,
            "human_speed": speed,
            "damping": damping,
            "role": 0.0,
        }
        return np.array([offset_then - offset])

    def internals(self) -> dict[str, float]:
        """Return velocity of the mass and speed of the human [m/s], and damping [N s/m].

        The role is 0: always a follower.
        """
        return self._internals
