"""The human that carries out a plan, with motor noise, tremor and slow visual correction."""

from collections import deque

import numpy as np
from colift.agents.agent import FRAME, HISTORY, Action, HumanObservation, Observation
from colift.agents.humans.hand import HandMemory, NoiseStream, move_hand
from colift.agents.humans.subject import Subject
from colift.agents.rules import SCALARS


class ScriptedHuman:
    """Carries out the private target of the observation as the subject would.

    The hand moves by :func:`.move_hand`. Its noise is drawn per frame and depends on the seed and
    the target alone, so that it is the same whatever the robot does.
    """

    def __init__(self, *, subject: Subject) -> None:
        self.subject = subject

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._noise = NoiseStream(self.subject, seed)
        self._memory = HandMemory(0.0, 0.0, 0.0)
        self._frame = 0
        self._past_target = 0.0
        self._missing: deque[float] = deque()

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        target = observation[HumanObservation.TARGET].tolist()
        n = len(target)
        noise = self._noise.between(self._frame, self._frame + n)
        steps, age = divmod(round(self.subject.visual_delay / FRAME), n)
        age = min(age, HISTORY - 1)
        self._missing.append(self._past_target - float(observation[HISTORY - 1 - age]))
        seen = self._missing.popleft() if len(self._missing) > steps else 0.0
        self._memory, references = move_hand(SCALARS, self._memory, seen, target, noise)
        self._frame += n
        self._past_target = target[-1 - age]
        return np.array(references)
