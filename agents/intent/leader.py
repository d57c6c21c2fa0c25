"""The person who leads the table to a pose, and waits for the other end."""

from typing import Final

import numpy as np

from ..agent import FRAME, HISTORY, Action, HumanObservation, Observation
from ..humans import ScriptedHuman, Subject
from .manner import leading_manner

FASTEST: Final = 0.35
"""Highest speed of a hand that catches up after waiting [m/s]: people lift at up to 0.3 m/s."""


class Leader:
    """Carries out a plan for both ends, no faster than the far end follows.

    Its observation is the intended height of the far end in each of the next n frames, then
    :class:`.HumanObservation`. With the far end seen to be e from its intended height, the hand
    moves at most at

        0.35 m/s * min(max(2 - e / patience, 0), 1)

    towards the plan. The hand is a person's own, with noise, tremor and correction
    (:class:`.ScriptedHuman`).
    """

    def __init__(self, *, subject: Subject) -> None:
        self._hand = ScriptedHuman(subject=subject)
        self._patience = leading_manner(subject).patience
        self._delay = round(subject.visual_delay / FRAME)

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._hand.reset(seed)
        self._height = 0.0
        self._meant = [0.0] * (self._delay + HISTORY)

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        frames = (len(observation) - HumanObservation.size(0)) // 2
        view = observation[frames:].copy()
        seen = float(view[HumanObservation.OTHER_END][-1])
        error = abs(seen - self._meant[-1 - self._delay])
        limit = FASTEST * FRAME * min(max(2.0 - error / self._patience, 0.0), 1.0)
        height, reachable = self._height, []
        for target in view[HumanObservation.TARGET].tolist():
            height += min(max(target - height, -limit), limit)
            reachable.append(height)
        self._height = height
        self._meant += observation[:frames].tolist()
        view[HumanObservation.TARGET] = reachable
        return self._hand.act(view)


def with_far_target(view: Observation, far: Observation) -> Observation:
    """Return the observation of a :class:`Leader`: the far end's target, then the senses."""
    return np.concatenate((far, view))
