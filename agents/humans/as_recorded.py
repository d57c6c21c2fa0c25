"""A person's recorded movement, at its own height and pace."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.agent import FRAME, Action, Agent, HumanObservation, Observation
from colift.agents.humans.movement import REST_AFTER, REST_BEFORE, interpolate
from colift.agents.humans.plan import Plan, assemble, still
from colift.agents.humans.recorded import Recorded, by_speed
from colift.agents.humans.recordings import Recording
from colift.agents.humans.shape import Shape, shape_of
from colift.agents.humans.subject import Subject
from numpy.typing import NDArray

UNCHANGED: Final = 1.0
"""Factor of heights and duration."""


@dataclass(frozen=True, kw_only=True)
class AsRecorded(Recorded):
    """Moves as a person was recorded to move, neither scaled nor slowed down.

    The hand adds no noise of its own and does not react: what was recorded has the person's.
    """

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, seed)``.

        The recording is smoothed like any (:class:`.Recorded`), begins at height 0, and is eased in
        and out in 0.4 s. From its last height the hand returns to the start. The seed draws the
        rests before and after; the subject has no effect on the plan.
        """
        before, after = np.random.default_rng(seed).random(2).tolist()
        return assemble(
            still("ready", 0.0, interpolate(REST_BEFORE, before)),
            *by_speed(_shape(self.recording).played(UNCHANGED, UNCHANGED)),
            still("rest", 0.0, interpolate(REST_AFTER, after)),
        )

    def person(self, subject: Subject) -> Agent:
        """Return a hand that follows the plan exactly."""
        return ExactHand()


class ExactHand:
    """A hand that moves as intended, whatever it observes."""

    def reset(self, seed: int) -> None:
        """Begin a lift; nothing is random."""

    def act(self, observation: Observation) -> Action:
        """Return the intended heights of the next n frames [m]."""
        return observation[HumanObservation.TARGET].copy()


def recorded_times(recording: Recording, plan: Plan) -> tuple[int, NDArray[np.float64]]:
    """Return the first frame in which a plan of :class:`AsRecorded` plays the recording, and times.

    They are the recorded time in each of these frames [s], from the first sample. Rests, and the
    return from the last height, are outside.
    """
    return plan.events[1][1], _shape(recording).times(UNCHANGED)


def heights_of(recording: Recording) -> tuple[float, float]:
    """Return the lowest and the highest height above the start [m], played as recorded."""
    shape = _shape(recording)
    return -shape.dip, shape.highest


def fastest_of(recording: Recording) -> float:
    """Return the highest smoothed speed of a recording [m/s]."""
    shape = _shape(recording)
    heights = shape.heights(max(2, round(shape.duration / FRAME)))
    return float(np.abs(np.diff(heights)).max()) / FRAME


def _shape(recording: Recording) -> Shape:
    return shape_of(recording, invert=False)
