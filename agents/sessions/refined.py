"""A network whose output is fitted again to each person."""

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.agents.sessions.acquainted import shipped_network
from colift.agents.sessions.refitting import LeastSquares, RefittingParameters
from colift.agents.sessions.sensor_age import SensorAge
from colift.agents.sessions.session_controller import SessionController
from numpy.typing import NDArray


class Refined:
    """Corrects a straight line by a network whose output is fitted again after each lift (ours).

    The network is that of ``acquainted,remember=false``, which knows no person. To its command is
    added w' u, with the network's units and 1 as u. The height difference e of the ends that was
    seen when the step's command had reached the table tells by how much that was wrong: after a
    lift, each of its steps improves the weights (:class:`.LeastSquares`), with the value w' u + e
    as it was in the lift, and w = 0 at first.
    """

    def __init__(self, *, parameters: RefittingParameters | None = None) -> None:
        self._parameters = parameters or RefittingParameters()
        self._controller = SessionController(shipped_network(remember=False), remember=False)
        self.begin_session()

    def begin_session(self) -> None:
        """Begin with a new person."""
        first = np.zeros(len(self._controller.units) + 1)
        self._fitted = LeastSquares(first, self._parameters.doubt)
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
            self._fitted.add(self._units[step], self._added[step] + self._apart[step + ahead])
        self._begin_lift()
        self._controller.reset(seed)

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        self._age.add(observation)
        change = self._controller.act(observation)
        units = np.append(self._controller.units, 1.0)
        added = self._fitted.value(units)
        self._units.append(units)
        self._added.append(added)
        robot = observation[RobotObservation.ROBOT_END]
        self._apart.append(float(observation[RobotObservation.HUMAN_END] - robot))
        return np.asarray(change) + added

    def internals(self) -> dict[str, float]:
        """Return the quantities of the network; see :meth:`.SessionController.internals`."""
        return self._controller.internals()
