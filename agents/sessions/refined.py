"""A network whose output is fitted again to each person."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.agents.sessions.acquainted import shipped_network
from colift.agents.sessions.sensor_age import SensorAge
from colift.agents.sessions.session_controller import SessionController
from colift.base.errors import InputError
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class RefinedParameters:
    """Parameters of :class:`Refined`."""

    remember: bool = True
    """Whether it learns from lift to lift; without, each lift is the first."""
    doubt: float = 1.0
    """Variance of the weights before the first lift, over that of the errors [1/m2]."""

    def __post_init__(self) -> None:
        """Check the range.

        Raises
        ------
        InputError
            If the doubt is negative or not finite.
        """
        if not 0 <= self.doubt < np.inf:
            raise InputError(f"doubt must be a number of at least 0, got {self.doubt}")


class Refined:
    """Corrects a straight line by a network whose output is fitted again after each lift (ours).

    The network is that of ``acquainted,remember=false``, which knows no person. To its command is
    added w' u, with the network's units and 1 as u. The height difference e of the ends that was
    seen when the step's command had reached the table tells by how much that was wrong: after a
    lift, each of its steps improves the weights by recursive least squares,

        k = P u / (1 + u' P u),  w <- w + k (y - u' w),  P <- P - k u' P,

    with y = w' u + e as it was in the lift, and w = 0 and P = doubt I at first.
    """

    def __init__(self, *, parameters: RefinedParameters | None = None) -> None:
        self._parameters = parameters or RefinedParameters()
        self._controller = SessionController(shipped_network(remember=False), remember=False)
        self.begin_session()

    def begin_session(self) -> None:
        """Begin with a new person."""
        size = len(self._controller.units) + 1
        self._weights, self._cov = np.zeros(size), self._parameters.doubt * np.eye(size)
        self._age = SensorAge()
        self._begin_lift()

    def _begin_lift(self) -> None:
        self._units: list[NDArray[np.float64]] = []
        self._added: list[float] = []
        self._apart: list[float] = []

    def reset(self, seed: int) -> None:
        """Begin a lift; the weights have learned from the last one."""
        if not self._parameters.remember:
            self.begin_session()
        self._age.end_lift()
        ahead = 1 + round(self._age.seconds / DEFAULT_PERIOD)
        for step in range(len(self._units) - ahead):
            self._learn(self._units[step], self._added[step] + self._apart[step + ahead])
        self._begin_lift()
        self._controller.reset(seed)

    def _learn(self, units: NDArray[np.float64], wanted: float) -> None:
        spread = (self._cov * units).sum(axis=1)
        gain = spread / (1.0 + float((units * spread).sum()))
        self._weights = self._weights + gain * (wanted - float((units * self._weights).sum()))
        self._cov = self._cov - gain[:, None] * spread

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        self._age.add(observation)
        change = self._controller.act(observation)
        units = np.append(self._controller.units, 1.0)
        added = float((units * self._weights).sum())
        self._units.append(units)
        self._added.append(added)
        robot = observation[RobotObservation.ROBOT_END]
        self._apart.append(float(observation[RobotObservation.HUMAN_END] - robot))
        return np.asarray(change) + added

    def internals(self) -> dict[str, float]:
        """Return the quantities of the network; see :meth:`.SessionController.internals`."""
        return self._controller.internals()
