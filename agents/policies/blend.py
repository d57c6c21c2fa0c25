"""The paper's framework: a blend of leader and follower by confidence (section III.C)."""

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.predictor import Predictor, PredictorParameters
from colift.agents.estimators.gain_control import gain_control
from colift.agents.policies.reactive import Reactive


class Blend:
    """Leads in proportion to the confidence in its prediction (Thobbi, Gu, Sheng 2011).

    The action is A = C P + (1 - C) R (eq. 8), P of :class:`.Proactive`, R of :class:`.Reactive`
    and C the confidence of eq. 7.
    """

    def __init__(self, *, parameters: PredictorParameters | None = None) -> None:
        self._predictor = Predictor(parameters)
        self._reactive = Reactive()

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._predictor.reset()

    def act(self, observation: Observation) -> Action:
        """Return the composite action [m]."""
        prediction, confidence = self._predictor.step(observation)
        proactive = prediction.height - float(observation[RobotObservation.HAND_HEIGHT])
        reactive = self._reactive.step(observation)
        self._internals = {
            "prediction": prediction.height,
            "predicted_velocity": prediction.velocity,
            "predicted_acceleration": prediction.acceleration,
            "confidence": confidence,
            "role": confidence,
        }
        return np.array([gain_control(confidence, proactive, reactive)])

    def internals(self) -> dict[str, float]:
        """Return the quantities behind the last action: prediction [m] with its rates, confidence.

        The role is 1 for a leader and 0 for a follower: here it is the confidence.
        """
        return self._internals
