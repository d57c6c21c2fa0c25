"""The person who steers the ball with the own end of the table, on top of lifting."""

import math
from collections import deque
from typing import Final

import numpy as np

from ..agent import FRAME, HISTORY, Action, HumanObservation, Observation
from ..humans import PARTNER_SUBJECT, ScriptedHuman, Subject
from ..humans.partner import PartnerParameters
from .facts import HALF_WEIGHT, PULL, meant_by_wrists
from .manner import PARTNER_MANNER, SteeringManner, steering_manner

DAMPING_RATIO: Final = 0.8
"""Damping with which people bring the ball to its target."""

STEEPEST: Final = 0.08
"""Largest wanted height difference of the ends [m]."""

FARTHEST: Final = 0.1
"""Largest distance of the own end from the plan of the lift [m]."""

FASTEST: Final = 0.25
"""Highest speed of the own end that steering adds [m/s]."""

HAND_TIME: Final = 0.1
"""Time constant with which the own end approaches where it should be [s]."""

MEMORY: Final = 2.0
"""Time over which a person judges the partner [s]."""


JOINING: Final = 1.2
"""Height difference that a person who does not know the target makes, relative to the one that the
other's wrists seem to mean."""

CALMING: Final = 0.2
"""Height difference that such a person adds by the ball's speed [s], against it."""


class BallSenses:
    """Index table of what a person sees of the ball, before :class:`.HumanObservation`."""

    PLACE: Final = slice(0, HISTORY)
    """Place of the ball [m] in ten frames, as old as the visual delay."""
    TARGET: Final = slice(HISTORY, 2 * HISTORY)
    """Where the ball should be [m] at the end of each of the next ten frames."""
    KNOWN: Final = 2 * HISTORY
    """1 if the person knows the target; else 0, and so are the places."""
    SIZE: Final = 2 * HISTORY + 1
    """Numbers before the other senses."""


def with_ball(view: Observation, places: list[float], target: Observation | None) -> Observation:
    """Return the observation of a :class:`Steerer`: the ball, its target, then the senses."""
    known = target is not None
    return np.concatenate((places, target if known else np.zeros(HISTORY), (float(known),), view))


class Steerer:
    """Carries the lift out, and steers the ball with a share of the height difference it takes."""

    def __init__(self, *, subject: Subject, manner: SteeringManner | None = None) -> None:
        self._hand = ScriptedHuman(subject=subject)
        self._steering = Steering(manner or steering_manner(subject), subject.visual_delay)

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._hand.reset(seed)
        self._steering.reset()

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        view = observation[BallSenses.SIZE :].copy()
        target = view[HumanObservation.TARGET]
        view[HumanObservation.TARGET] = target + self._steering.offsets(observation, target, -1.0)
        return self._hand.act(view)


class Steering:
    """A delayed controller of the ball through the height of one end of the table."""

    def __init__(self, manner: SteeringManner, delay: float) -> None:
        self._manner = manner
        self._delay = round(delay / FRAME)

    def reset(self) -> None:
        """Begin an episode."""
        self._offset = 0.0
        self._own: deque[float] = deque([0.0] * (self._delay + 1), self._delay + 1)
        self._planned: deque[float] = deque([0.0] * (self._delay + 1), self._delay + 1)
        self._wanted = 0.0
        self._product, self._square = 0.0, 1e-4

    def offsets(self, observation: Observation, plan: Observation, side: float) -> list[float]:
        """Return how far the own end should be from the plan [m] in each frame of the step.

        ``side`` is 1 for the far end, whose height makes the difference larger, and -1 for the
        near one.
        """
        manner, frames = self._manner, len(plan)
        period = frames * FRAME
        places = observation[BallSenses.PLACE].tolist()
        view = observation[BallSenses.SIZE :]
        own = view[HumanObservation.OWN_HEIGHT].tolist()
        other = float(view[HumanObservation.OTHER_END][-1])
        self._own.extend(own[-frames:])
        seen = side * (self._own[0] - other)

        partner = -side * (other - self._planned[0])
        kept = math.exp(-period / MEMORY)
        self._product = kept * self._product + period * partner * self._wanted
        self._square = kept * self._square + period * self._wanted**2
        done = min(max(self._product / (self._square + 1e-4), 0.0), 1.0)
        self._planned.extend(plan.tolist())

        speed = (places[-1] - places[0]) / (FRAME * (HISTORY - 1))
        lead = manner.lead
        place = places[-1] + lead * speed - PULL * seen * lead * lead / 2
        speed -= PULL * seen * lead
        target = observation[BallSenses.TARGET].tolist()
        half = (HISTORY - 1) // 2
        known = observation[BallSenses.KNOWN] > 0.5
        first, middle, last = target[0], target[half], target[2 * half]
        span = half * FRAME
        error, slip = place - middle, speed - (last - first) / (2 * span)
        push = (last - 2 * middle + first) / span**2
        rate = manner.haste
        wanted = (rate**2 * error + 2 * DAMPING_RATIO * rate * slip - push) / PULL
        if not known:
            felt = float(view[HumanObservation.HAND_FORCE].mean())
            wanted = JOINING * meant_by_wrists(felt - HALF_WEIGHT, seen, place) + CALMING * speed
        self._wanted = wanted = min(max(wanted, -STEEPEST), STEEPEST)
        share = manner.share * (1.0 - manner.trust * done) if known else 1.0
        aim = side * share * wanted
        aim = min(max(aim, -FARTHEST), FARTHEST)
        offsets = []
        for _ in range(frames):
            change = (aim - self._offset) * FRAME / HAND_TIME
            self._offset += min(max(change, -FASTEST * FRAME), FASTEST * FRAME)
            offsets.append(self._offset)
        return offsets


class BallPartner:
    """The second person: keeps the table level, and steers the ball as the first does.

    It follows the other end as :class:`.Partner` does. If it does not know the target, it joins in
    what it feels of the other's wrists.
    """

    def __init__(
        self,
        *,
        subject: Subject = PARTNER_SUBJECT,
        manner: SteeringManner = PARTNER_MANNER,
        parameters: PartnerParameters | None = None,
    ) -> None:
        parameters = parameters or PartnerParameters()
        self._hand = ScriptedHuman(subject=subject)
        self._steering = Steering(manner, subject.visual_delay)
        self._ahead = subject.visual_delay - parameters.lag
        self._memory = parameters.velocity_memory

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._hand.reset(seed)
        self._steering.reset()
        self._height = self._velocity = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        view = observation[BallSenses.SIZE :].copy()
        frames = len(view[HumanObservation.TARGET])
        new = view[HumanObservation.OTHER_END][-frames:].tolist()
        # A step longer than the history leaves a gap before the first new frame.
        elapsed = (frames - len(new) + 1) * FRAME
        for height in new:
            velocity = (height - self._height) / elapsed
            self._velocity -= math.expm1(-elapsed / self._memory) * (velocity - self._velocity)
            self._height = height
            elapsed = FRAME
        future = self._ahead + FRAME * np.arange(1, frames + 1)
        level = self._height + self._velocity * future
        offsets = self._steering.offsets(observation, level, 1.0)
        view[HumanObservation.TARGET] = level + offsets
        return self._hand.act(view)
