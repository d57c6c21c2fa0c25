"""Linear extrapolation: the human is assumed to move on as in the last step."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.base.errors import InputError


@dataclass(frozen=True, kw_only=True)
class ExtrapolateParameters:
    """Parameters of :class:`Extrapolate`."""

    steps: float = 2.0
    """Prediction horizon in control periods. With the paper's timing the sample is one period old
    and the command takes another one: hence two, which is not tuned."""

    def __post_init__(self) -> None:
        """Check the range.

        Raises
        ------
        InputError
            If the number of steps is negative or not finite.
        """
        if not 0 <= self.steps < np.inf:
            raise InputError(f"steps must be a number of at least 0, got {self.steps}")


class Extrapolate:
    """Goes to the linearly extrapolated height of the human (ours).

    With z_k the seen height of the human's end and d the horizon in ``steps``, the command becomes

        u = z_k + d (z_k - z_(k-1)).

    The noise of u is sqrt((1 + d)^2 + d^2) times that of the motion capture: 0.8 mm for two steps.
    It has no model and no confidence: the reference that every method of prediction should beat. It
    is not one of the methods that the paper cites.
    """

    def __init__(self, *, parameters: ExtrapolateParameters | None = None) -> None:
        self._steps = (parameters or ExtrapolateParameters()).steps

    def reset(self, seed: int) -> None:
        """Begin an episode without any samples."""
        self._last: float | None = None

    def act(self, observation: Observation) -> Action:
        """Return the change [m] that brings the command to the extrapolated height."""
        height = float(observation[RobotObservation.HUMAN_END])
        change = 0.0 if self._last is None else height - self._last
        self._last = height
        self._prediction = height + self._steps * change
        return np.array([self._prediction - observation[RobotObservation.HAND_COMMAND]])

    def internals(self) -> dict[str, float]:
        """Return the extrapolated height of the human's end [m]."""
        return {"prediction": self._prediction}
