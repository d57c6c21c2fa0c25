"""The simplest prediction: the human goes on as in the last step."""

from dataclasses import dataclass

import numpy as np

from ..agent import Action, Observation, RobotObservation
from ..errors import InputError


@dataclass(frozen=True, kw_only=True)
class ExtrapolateParameters:
    """Parameters of :class:`Extrapolate`."""

    steps: float = 2.0
    """How far to look ahead, in control periods. With the paper's timing the sample is one period
    old and the command takes another: two, which is not tuned."""

    def __post_init__(self) -> None:
        """Check the range.

        Raises
        ------
        InputError
            If the number of steps is negative or not finite.
        """
        if not 0 <= self.steps < np.inf:
            raise InputError(f"steps must be a number from 0 on, got {self.steps}")


class Extrapolate:
    """Goes where the human will be if it moves on as in the last step: a straight line (ours).

    With z_k the height of the human's end as seen and d the ``steps`` to look ahead, the command
    becomes

        u = z_k + d (z_k - z_(k-1)).

    The noise of u is sqrt((1 + d)^2 + d^2) times that of the motion capture: 0.8 mm for two steps.
    There is no model to be wrong and nothing to trust or distrust: what every method of prediction
    has to beat. It is no method of the literature that the paper cites.
    """

    def __init__(self, *, parameters: ExtrapolateParameters | None = None) -> None:
        self._steps = (parameters or ExtrapolateParameters()).steps

    def reset(self, seed: int) -> None:
        """Begin an episode: nothing was seen yet."""
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
