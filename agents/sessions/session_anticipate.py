"""Anticipation that finds out the age of its samples."""

import dataclasses
from dataclasses import dataclass

from colift.agents.agent import Action, Observation
from colift.agents.control.anticipation import load_anticipation
from colift.agents.policies.anticipate import AnticipateParameters, AnticipationController
from colift.agents.sessions.sensor_age import SensorAge


@dataclass(frozen=True, kw_only=True)
class SessionAnticipateParameters:
    """Parameters of :class:`SessionAnticipate`."""

    remember: bool = True
    """Whether the age is kept from lift to lift."""


class SessionAnticipate:
    """Plans as :class:`.Anticipate`, farther ahead if the samples are older than usual (ours).

    Its forecast was learned with samples of one age; the age of the session's
    (:class:`.SensorAge`) beyond that is added to the time by which the arm is behind.
    """

    def __init__(self, *, parameters: SessionAnticipateParameters | None = None) -> None:
        self._remember = (parameters or SessionAnticipateParameters()).remember
        self._model = load_anticipation()
        self.begin_session()

    def begin_session(self) -> None:
        """Begin with a new person and unknown sensors."""
        self._age = SensorAge()

    def reset(self, seed: int) -> None:
        """Begin a lift."""
        if not self._remember:
            self.begin_session()
        self._age.end_lift()
        usual = AnticipateParameters()
        lag = max(usual.arm_lag + self._age.seconds - self._model.latency, 0.0)
        parameters = dataclasses.replace(usual, arm_lag=lag)
        self._controller = AnticipationController(self._model, parameters)
        self._controller.reset(seed)

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        self._age.add(observation)
        return self._controller.act(observation)

    def internals(self) -> dict[str, float]:
        """Return the quantities of :meth:`.AnticipationController.internals`."""
        return self._controller.internals()
