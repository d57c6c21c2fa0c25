"""The ball by inference of the person's aim, and of the missing part of the steering."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.ranges import NotNegative, check_ranges
from colift.agents.tasks.ball.aim_filter import (
    DAMPING,
    FELT_NOISE,
    RATE,
    AimFilter,
    wanted_difference,
)
from colift.agents.tasks.ball.observation import BallObservation
from colift.agents.tasks.ball.tracking import Tracking


@dataclass(frozen=True, kw_only=True)
class BallGameParameters:
    """Parameters of :class:`BallGame`."""

    ahead: NotNegative = 0.084
    """Time from now at which a command acts, on average [s]."""
    gain: NotNegative = 0.8
    """Height difference relative to that of the person's law."""
    steepest: NotNegative = 0.14
    """Largest height difference [m]."""
    felt_noise: NotNegative = FELT_NOISE
    """See :class:`.AimFilter` [m]; a value of 1 switches the use of the wrists off."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


class BallGame:
    """Infers where the ball should be, and does the steering that the person leaves undone.

    **Ball.** A Kalman filter predicts place and speed for the time at which the command acts.

    **Aim.** A known target gives the aim with its velocity and acceleration. Otherwise
    :class:`.AimFilter` infers it from the torque of the person's wrists, together with the part of
    the wanted inclination that this person's wrists show.

    **Rest.** The law is that of an undelayed person (:func:`.wanted_difference`). The forecast of
    the human's end includes the human's part of it; the robot's end makes up the rest.
    """

    def __init__(self, *, parameters: BallGameParameters | None = None) -> None:
        self._parameters = parameters or BallGameParameters()
        self._tracking, self._aim = Tracking(), AimFilter(self._parameters.felt_noise)

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._tracking.reset()
        self._aim.reset()
        self._targets: list[float] = []

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        parameters, tracking = self._parameters, self._tracking
        tracking.observe(observation)
        period = tracking.inclining.period
        self._aim.update(*tracking.sample, tracking.meant(), period)
        aim = self._aim.aim
        if observation[BallObservation.TARGET_KNOWN] > 0.5:
            aim = self._known(float(observation[BallObservation.TARGET_PLACE]), period)
        place, speed = tracking.ahead(parameters.ahead)
        limit = parameters.steepest
        difference = parameters.gain * wanted_difference(place, speed, aim)
        difference = min(max(difference, -limit), limit)
        self._internals = {"aim": aim, "inferred_aim": self._aim.aim, "part": self._aim.part}
        return np.array([tracking.inclining.change(observation, difference)])

    def internals(self) -> dict[str, float]:
        """Return the aim that is steered for and the inferred one [m], and the part shown."""
        return self._internals

    def _known(self, target: float, period: float) -> float:
        """Return the aim of a known target at the time when the command acts [m]."""
        self._targets = [*self._targets[-2:], target]
        if len(self._targets) < 3:
            return target
        first, middle, last = self._targets
        push = (last - 2 * middle + first) / period**2
        speed = (last - middle) / period + push * period / 2
        ahead = period
        then = target + speed * ahead
        return then + 2 * DAMPING / RATE * (speed + push * ahead) + push / RATE**2
