"""The second human, who keeps the table level and steers the ball as the first does."""

import math
from collections import deque
from typing import Final

import numpy as np
from colift.agents.agent import FRAME, HISTORY, Action, HumanObservation, Observation
from colift.agents.humans import SECOND_PERSON, ScriptedHuman, Subject
from colift.agents.humans.second_person import SecondPersonParameters
from colift.agents.rules import SCALARS
from colift.benchmark.tasks.ball.manner import PARTNER_MANNER, SteeringManner
from colift.benchmark.tasks.ball.steering import (
    SQUARE,
    BallTarget,
    SteeringMemory,
    SteeringSenses,
    felt,
    steer,
)


class BallSenses:
    """Index table of what a person sees of the ball; :class:`.HumanObservation` follows."""

    PLACE: Final = slice(0, HISTORY)
    """Place of the ball [m] in ten frames, as old as the visual delay."""
    TARGET: Final = slice(HISTORY, 2 * HISTORY)
    """Intended place of the ball [m] at the end of each of the next ten frames."""
    KNOWN: Final = 2 * HISTORY
    """1 if the person knows the target; else 0, and then the intended places are 0 too."""
    SIZE: Final = 2 * HISTORY + 1
    """Numbers before the other senses."""


def with_ball(view: Observation, places: list[float], target: Observation | None) -> Observation:
    """Return a person's observation: the ball, its target, then the senses."""
    known = np.array([float(target is not None)])
    coming = np.zeros(HISTORY) if target is None else target
    return np.concatenate((np.array(places), coming, known, view))


class BallPartner:
    """The second person: keeps the table level, and steers the ball as the first does.

    It follows the other end as :class:`.SecondPerson` does. If it does not know the target, it
    follows the torque that it feels from the other's wrists.
    """

    def __init__(
        self,
        *,
        subject: Subject = SECOND_PERSON,
        manner: SteeringManner[float] = PARTNER_MANNER,
        parameters: SecondPersonParameters | None = None,
    ) -> None:
        parameters = parameters or SecondPersonParameters()
        self._hand = ScriptedHuman(subject=subject)
        self._manner = manner
        self._delay = round(subject.visual_delay / FRAME)
        self._ahead = subject.visual_delay - parameters.lag
        self._memory = parameters.velocity_memory

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._hand.reset(seed)
        self._height = self._velocity = 0.0
        self._steering = SteeringMemory(0.0, 0.0, 0.0, SQUARE)
        self._own: deque[float] = deque([0.0] * (self._delay + 1), self._delay + 1)
        self._planned: deque[float] = deque([0.0] * (self._delay + 1), self._delay + 1)

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        view = observation[BallSenses.SIZE :].copy()
        level = self._level(view)
        senses = self._senses(observation.tolist(), level)
        self._steering, offsets = steer(
            SCALARS, self._manner, self._steering, senses, 1.0, len(level)
        )
        view[HumanObservation.TARGET] = np.array(level) + offsets
        return self._hand.act(view)

    def _level(self, view: Observation) -> list[float]:
        """Return the expected height of the other end in each of the next n frames [m]."""
        frames = len(view[HumanObservation.TARGET])
        new = view[HumanObservation.OTHER_END][-frames:].tolist()
        # A step longer than the history leaves a gap before the first new frame.
        elapsed = (frames - len(new) + 1) * FRAME
        for height in new:
            velocity = (height - self._height) / elapsed
            self._velocity -= math.expm1(-elapsed / self._memory) * (velocity - self._velocity)
            self._height = height
            elapsed = FRAME
        return [
            self._height + self._velocity * (self._ahead + FRAME * i) for i in range(1, frames + 1)
        ]

    def _senses(self, numbers: list[float], level: list[float]) -> SteeringSenses[float]:
        view, frames = numbers[BallSenses.SIZE :], len(level)
        planned = self._planned[0]
        self._planned.extend(level)
        own = view[HumanObservation.OWN_HEIGHT]
        self._own.extend([own[0]] * (frames - len(own)) + own[-frames:])
        places, target = numbers[BallSenses.PLACE], numbers[BallSenses.TARGET]
        half = (HISTORY - 1) // 2
        return SteeringSenses(
            own=self._own[0],
            other=view[HumanObservation.OTHER_END][-1],
            planned=planned,
            place=places[-1],
            speed=(places[-1] - places[0]) / (FRAME * (HISTORY - 1)),
            target=BallTarget(target[0], target[half], target[2 * half]),
            span=half * FRAME,
            known=numbers[BallSenses.KNOWN],
            felt=felt(view[HumanObservation.HAND_FORCE]),
        )
