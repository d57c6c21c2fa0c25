"""The paper's proactive controller alone: leading by prediction (section III.B)."""

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.predictor import Predictor, PredictorParameters


class Proactive:
    """Goes to the predicted height of the human (Thobbi, Gu, Sheng 2011, section III.B).

    P = predicted height of the human's end - height of the robot's hand.
    """

    def __init__(self, *, parameters: PredictorParameters | None = None) -> None:
        self._predictor = Predictor(parameters)

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._predictor.reset()

    def act(self, observation: Observation) -> Action:
        """Return the movement to the predicted height [m]."""
        prediction, confidence = self._predictor.step(observation)
        self._internals = {
            "prediction": prediction.height,
            "predicted_velocity": prediction.velocity,
            "predicted_acceleration": prediction.acceleration,
            "confidence": confidence,
            "role": 1.0,
        }
        return np.array([prediction.height - observation[RobotObservation.HAND_HEIGHT]])

    def internals(self) -> dict[str, float]:
        """Return the quantities behind the last action: prediction [m], confidence, role."""
        return self._internals
