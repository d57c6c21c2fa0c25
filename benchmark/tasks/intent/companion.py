"""The second of two people, who feels where the first wants the table."""

import math
from typing import Final

import numpy as np
from colift.agents.agent import FRAME, Action, HumanObservation, Observation
from colift.agents.humans import SECOND_PERSON, ScriptedHuman
from colift.agents.humans.felt import felt_force
from colift.agents.tasks.intent.pose_filter import PoseFilter, PoseFilterParameters
from colift.agents.tasks.touch.touched import TABLE_LENGTH

VELOCITY_MEMORY: Final = 0.1
"""Time constant with which the seen velocity is smoothed [s]."""

FEELING: Final = PoseFilterParameters(switch=0.015, pitch_noise=0.05, path_noise=0.1, haste=0.5)
"""A person's touch is coarser than a robot's sensors, and a person's estimate of the partner
changes more slowly. The values are chosen such that a lift does not depend on the time step of the
physics."""


class Companion:
    """Keeps the far end where the other person wants it, as a person would.

    Sight of the other end is one visual delay old, the felt force one haptic delay; the present
    height of the other end is extrapolated with the seen velocity. A :class:`.PoseFilter` estimates
    the intended height, and the hand moves as a person's (:class:`.ScriptedHuman`).
    """

    def __init__(self) -> None:
        self._hand = ScriptedHuman(subject=SECOND_PERSON)
        self._filter = PoseFilter(FEELING)
        self._delay = SECOND_PERSON.visual_delay

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._hand.reset(seed)
        self._filter.reset()
        self._height = self._velocity = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        frames = len(observation[HumanObservation.TARGET])
        self._look(observation[HumanObservation.OTHER_END][-frames:].tolist())
        near = self._height + self._velocity * self._delay
        own = float(observation[HumanObservation.OWN_HEIGHT][-1])
        sine = min(max((own - near) / TABLE_LENGTH, -0.9), 0.9)
        self._filter.update(near, math.asin(sine), felt_force(observation))
        rate = self._filter.share * self._velocity
        meant = observation.copy()
        coming = FRAME * np.arange(1, frames + 1)
        meant[HumanObservation.TARGET] = self._filter.height + rate * coming
        return self._hand.act(meant)

    def _look(self, heights: list[float]) -> None:
        """Add the newest heights of the other end, one per frame [m]."""
        smoothing = -math.expm1(-FRAME / VELOCITY_MEMORY)
        for height in heights:
            self._velocity += smoothing * ((height - self._height) / FRAME - self._velocity)
            self._height = height
