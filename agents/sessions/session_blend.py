"""The paper's blend, whose filter is tuned again to each person."""

import dataclasses
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.predictor import Predictor, PredictorParameters
from colift.agents.estimators.gain_control import gain_control
from colift.agents.policies.reactive import Reactive
from colift.agents.sessions.sensor_age import SensorAge

FACTORS: Final = (0.01, 0.1, 1.0, 10.0, 100.0)
"""Process noise that is tried after each lift, relative to the shipped one."""


@dataclass(frozen=True, kw_only=True)
class SessionBlendParameters:
    """Parameters of :class:`SessionBlend`."""

    remember: bool = True
    """Whether it learns from lift to lift; without, each lift is the first, as of ``blend``."""


class SessionBlend:
    """Blends as :class:`.Blend`, with what the lifts before have taught (ours).

    After each lift the process noise of the Kalman filter is the one of :data:`FACTORS` with the
    least squared error of the predictions in all lifts of the session, and the prediction goes as
    far ahead as the samples are old (:class:`.SensorAge`).
    """

    def __init__(self, *, parameters: SessionBlendParameters | None = None) -> None:
        self._remember = (parameters or SessionBlendParameters()).remember
        self._usual = PredictorParameters()
        self._reactive = Reactive()
        self.begin_session()

    def begin_session(self) -> None:
        """Begin with a new person."""
        self._age: SensorAge | None = None
        self._errors = dict.fromkeys(FACTORS, 0.0)
        self._lift: list[Observation] = []
        self._ages = SensorAge()

    def reset(self, seed: int) -> None:
        """Begin a lift, with the filter that would have been best in those before."""
        if not self._remember:
            self.begin_session()
        if len(self._lift) > 1:
            self._ages.end_lift()
            self._age = self._ages
            for factor in FACTORS:
                self._errors[factor] += self._error(factor)
        self._lift = []
        best = min(FACTORS, key=lambda factor: (self._errors[factor], abs(np.log(factor))))
        self._predictor = self._with_noise(best)

    def _with_noise(self, factor: float) -> Predictor:
        motion = self._usual.motion
        noise = dataclasses.replace(motion, process_noise=factor * motion.process_noise)
        predictor = Predictor(dataclasses.replace(self._usual, motion=noise))
        predictor.reset()
        return predictor

    def _error(self, factor: float) -> float:
        """Return the squared error of the predictions of a filter in the last lift [m2]."""
        predictor, total = self._with_noise(factor), 0.0
        made: list[float] = []
        for observation in self._lift:
            predictor.step(observation)
            ahead = self._ages.seconds + predictor.period
            steps = max(round(ahead / predictor.period), 1)
            if len(made) >= steps:
                total += (made[-steps] - float(observation[RobotObservation.HUMAN_END])) ** 2
            made.append(predictor.ahead(ahead).height)
        return total

    def act(self, observation: Observation) -> Action:
        """Return the composite action [m]."""
        self._lift.append(np.array(observation))
        self._ages.add(observation)
        prediction, confidence = self._predictor.step(observation)
        if self._age is not None:
            prediction = self._predictor.ahead(self._age.seconds + self._predictor.period)
        proactive = prediction.height - float(observation[RobotObservation.HAND_HEIGHT])
        reactive = self._reactive.step(observation)
        self._internals = {
            "prediction": prediction.height,
            "confidence": confidence,
            "role": confidence,
        }
        return np.array([gain_control(confidence, proactive, reactive)])

    def internals(self) -> dict[str, float]:
        """Return the prediction [m], and the confidence, which is the role."""
        return self._internals
