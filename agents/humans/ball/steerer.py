"""The person who steers the ball with one end of the table while lifting."""

import math
from collections import deque
from typing import Final

import numpy as np
from colift.agents.agent import FRAME, HISTORY, Action, HumanObservation, Observation
from colift.agents.ball.facts import HALF_WEIGHT, PULL, meant_by_wrists
from colift.agents.humans import PARTNER_SUBJECT, ScriptedHuman, Subject
from colift.agents.humans.ball.manner import PARTNER_MANNER, SteeringManner, steering_manner
from colift.agents.humans.partner import PartnerParameters

DAMPING_RATIO: Final = 0.8
"""Damping ratio with which people bring the ball to its target."""

STEEPEST: Final = 0.08
"""Largest wanted height difference of the ends [m]."""

FARTHEST: Final = 0.1
"""Largest distance of the person's end from the plan of the lift [m]."""

FASTEST: Final = 0.25
"""Highest speed that steering adds to the person's end [m/s]."""

HAND_TIME: Final = 0.2
"""Time constant with which the person's end approaches its wanted height [s], an assumption: with a
smaller one, two people who steer oscillate, and the error of a lift depends on differences of
micrometres."""

MEMORY: Final = 2.0
"""Time over which a person judges the partner [s]."""


JOINING: Final = 1.2
"""Height difference that a person who does not know the target makes, relative to the one that the
other's wrists seem to mean."""

CALMING: Final = 0.2
"""Height difference that such a person adds against the ball's speed [m per m/s]."""


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
    """Return the observation of a :class:`Steerer`: the ball, its target, then the senses."""
    known = np.array([float(target is not None)])
    coming = np.zeros(HISTORY) if target is None else target
    return np.concatenate((np.array(places), coming, known, view))


class Steerer:
    """Carries out the lift, and steers the ball with a share of the necessary height difference."""

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
    """A delayed controller of the ball through the height of one end of the table.

    With the haste w, the damping ratio z, and the ball's place s and speed v as seen a visual delay
    ago and extrapolated by the person's lead, the person wants the height difference

        d = (w^2 (s - x) + 2 z w (v - x') - x'') / PULL,

    far above near, for a target at x. The person's end makes the part ``share (1 - trust done)`` of
    it. ``done`` is the part that the partner seems to do: the regression, over the last seconds, of
    the other end's distance from the lift on the wanted difference.

    A person who does not know the target wants a multiple of the height difference that the other's
    wrists seem to mean (:func:`.meant_by_wrists`), less a term that slows down the ball, and makes
    all of it.
    """

    def __init__(self, manner: SteeringManner, delay: float) -> None:
        self._manner = manner
        self._delay = round(delay / FRAME)

    def reset(self) -> None:
        """Begin an episode."""
        self._offset = self._wanted = 0.0
        self._own: deque[float] = deque([0.0] * (self._delay + 1), self._delay + 1)
        self._planned: deque[float] = deque([0.0] * (self._delay + 1), self._delay + 1)
        self._product, self._square = 0.0, 1e-4

    def offsets(self, observation: Observation, plan: Observation, side: float) -> list[float]:
        """Return the distance of the person's end from the plan [m] in each frame of the step.

        ``side`` is 1 for the far end, whose height makes the difference larger, and -1 for the
        near one.
        """
        manner, frames = self._manner, len(plan)
        view = observation[BallSenses.SIZE :]
        other = float(view[HumanObservation.OTHER_END][-1])
        done = self._done(-side * (other - self._planned[0]), frames * FRAME)
        self._planned.extend(plan.tolist())
        self._own.extend(view[HumanObservation.OWN_HEIGHT].tolist()[-frames:])
        wanted = self._wanting(observation, side * (self._own[0] - other))
        self._wanted = wanted = min(max(wanted, -STEEPEST), STEEPEST)

        known = observation[BallSenses.KNOWN] > 0.5
        share = manner.share * (1.0 - manner.trust * done) if known else 1.0
        aim = min(max(side * share * wanted, -FARTHEST), FARTHEST)
        offsets = []
        for _ in range(frames):
            change = (aim - self._offset) * FRAME / HAND_TIME
            self._offset += min(max(change, -FASTEST * FRAME), FASTEST * FRAME)
            offsets.append(self._offset)
        return offsets

    def _done(self, partner: float, period: float) -> float:
        """Return the part of the wanted difference that the partner seems to make, 0 to 1."""
        kept = math.exp(-period / MEMORY)
        self._product = kept * self._product + period * partner * self._wanted
        self._square = kept * self._square + period * self._wanted**2
        return min(max(self._product / (self._square + 1e-4), 0.0), 1.0)

    def _wanting(self, observation: Observation, seen: float) -> float:
        """Return the wanted height difference [m], given the seen one."""
        places: list[float] = observation[BallSenses.PLACE].tolist()
        speed = (places[-1] - places[0]) / (FRAME * (HISTORY - 1))
        lead, rate = self._manner.lead, self._manner.haste
        place = places[-1] + lead * speed - PULL * seen * lead * lead / 2
        speed -= PULL * seen * lead
        if observation[BallSenses.KNOWN] < 0.5:
            forces: list[float] = observation[BallSenses.SIZE :][
                HumanObservation.HAND_FORCE
            ].tolist()
            felt = math.fsum(forces) / HISTORY - HALF_WEIGHT
            return JOINING * meant_by_wrists(felt, seen, place) + CALMING * speed
        target: list[float] = observation[BallSenses.TARGET].tolist()
        half = (HISTORY - 1) // 2
        first, middle, last = target[0], target[half], target[2 * half]
        span = half * FRAME
        slip = speed - (last - first) / (2 * span)
        push = (last - 2 * middle + first) / span**2
        return (rate**2 * (place - middle) + 2 * DAMPING_RATIO * rate * slip - push) / PULL


class BallPartner:
    """The second person: keeps the table level, and steers the ball as the first does.

    It follows the other end as :class:`.Partner` does. If it does not know the target, it follows
    the torque that it feels from the other's wrists.
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
        level = np.asarray(self._height + self._velocity * future, dtype=np.float64)
        offsets = self._steering.offsets(observation, level, 1.0)
        view[HumanObservation.TARGET] = level + offsets
        return self._hand.act(view)
