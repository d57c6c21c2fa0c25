"""The partner, the second of two people."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.agent import FRAME, Action, HumanObservation, Observation
from colift.agents.calibration import CALIBRATION
from colift.agents.humans.felt import FELT_HEIGHT, felt_force
from colift.agents.humans.scripted import ScriptedHuman
from colift.agents.humans.subject import Subject

SECOND_PERSON: Final = Subject(
    name="partner",
    amplitude=0.22,
    duration=2.1,
    lowering_ratio=1.05,
    submovements=(0, 0),
    motor_noise=0.03,
    tremor_amplitude=0.06e-3,
    tremor_frequency=8.0,
    visual_delay=0.150,
    haptic_delay=0.070,
    stiffness=200.0,
    damping=16.0,
    mass=0.8,
    pull=0.4,
    felt_share=1.0,
)
"""The person at the far end in every lift of two people: always the same person, as
there is only one robot.

Sight about 150 ms old and a faster sense of force; a light, well damped arm that yields to it.
These are choices inside the ranges of the literature; the height and duration of the partner's own
lifts have no effect.
"""


@dataclass(frozen=True, kw_only=True)
class SecondPersonParameters:
    """Parameters of :class:`SecondPerson`."""

    lag: float = CALIBRATION.partner_lag
    """Intended lag behind the other person [s]: the only calibrated number, chosen so that two
    people have the RMSE of the paper's pair, 6.531 mm."""

    velocity_memory: float = 0.1
    """Time constant with which the seen velocity is smoothed [s]: one control period."""

    yielding: float = 0.12
    """Part of the felt height difference that the intention makes up: an assumption, half of the
    gain at which some of the suites' pairs begin to swing (0.25; at 0.28 one lift in four fails).
    """


class SecondPerson:
    """Keeps the table level with another person, as a person would.

    It sees the other end ``visual_delay`` late, at the height z with the smoothed velocity v, and
    feels ``haptic_delay`` late the force F of its hands beyond half of the table's weight. It
    intends to be where the other will be, less its lag, and gives way to the force:

        r(t) = z + v (visual_delay + t - lag) - yielding F L^2 / k,  t the time from now,

    with the length L of the table and the stiffness k of the other's grip: at rest, F L^2 / k is
    the height of the own end above the other one. The hand moves as a person's, with noise and
    tremor (:class:`.ScriptedHuman`); its body has a reflex besides.
    """

    def __init__(
        self,
        *,
        subject: Subject = SECOND_PERSON,
        parameters: SecondPersonParameters | None = None,
    ) -> None:
        self._parameters = parameters or SecondPersonParameters()
        self._hand = ScriptedHuman(subject=subject)
        self._ahead = subject.visual_delay - self._parameters.lag

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._hand.reset(seed)
        self._height = self._velocity = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        frames = len(observation[HumanObservation.TARGET])
        new = observation[HumanObservation.OTHER_END][-frames:].tolist()
        # A step longer than the history leaves a gap before the first new frame.
        elapsed = (frames - len(new) + 1) * FRAME
        for height in new:
            smoothing = -math.expm1(-elapsed / self._parameters.velocity_memory)
            velocity = (height - self._height) / elapsed
            self._velocity += smoothing * (velocity - self._velocity)
            self._height = height
            elapsed = FRAME
        future = self._ahead + FRAME * np.arange(1, frames + 1)
        apart = felt_force(observation) * FELT_HEIGHT
        wanted = self._height - self._parameters.yielding * apart
        meant = observation.copy()
        meant[HumanObservation.TARGET] = wanted + self._velocity * future
        return self._hand.act(meant)
