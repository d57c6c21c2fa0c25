"""Proportional feedback: a reference in comparisons, and a template for policies."""

import math
from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.base.errors import InputError


@dataclass(frozen=True, kw_only=True)
class ProportionalParameters:
    """Parameter of :class:`Proportional`."""

    gain: float = 1.8
    """Fraction of the seen difference that one step removes.

    A gain of 1 goes to the human's last height; a higher one goes beyond it, which suits a moving
    human. Minimising the error alone would make the hand ring: with ``colift run
    proportional,gain=G --seeds 5000:5005`` (seeds of no suite) it falls from 19.9 mm at 1 to 16.3
    at 1.8 and 13.8 at 3.4, and from 3.6 on the hand oscillates without end. The default is half of
    that, a gain margin of 2."""

    def __post_init__(self) -> None:
        """Check the range.

        Raises
        ------
        InputError
            If the gain is not a positive number.
        """
        if not 0 < self.gain < math.inf:
            raise InputError(f"gain must be a positive number, got {self.gain}")


class Proportional:
    """Removes a fixed fraction of the height difference that it sees (proportional feedback).

    The change of the command is gain (human - hand), with the human's end from motion capture and
    the hand from its encoders, which compensates for its sag under the table. Behind a human of
    steady speed v it lags by v (latency + period / gain). It predicts nothing.
    """

    def __init__(self, *, parameters: ProportionalParameters | None = None) -> None:
        self._gain = (parameters or ProportionalParameters()).gain

    def reset(self, seed: int) -> None:
        """Begin an episode; there is nothing to prepare."""

    def act(self, observation: Observation) -> Action:
        """Return the change of the hand command [m]."""
        human = observation[RobotObservation.HUMAN_END]
        hand = observation[RobotObservation.HAND_HEIGHT]
        return np.array([self._gain * (human - hand)])
