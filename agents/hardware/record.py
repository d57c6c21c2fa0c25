"""The record of a trial: every frame and every step, in the order in which they came."""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

from .ports import Sample
from .stops import Stop


class Step(NamedTuple):
    """One control period."""

    time: float
    """When it began [s]."""
    deadline: float
    """When it should have begun [s]."""
    hand_height: float
    """Height of the hands by the encoders [m]."""
    set_point: float
    """Height of the hands by the robot's set-points [m]."""
    stiffness: float
    """Lowest stiffness of the arms' motors."""
    astray: float
    """How far a joint's set-point was from where the commands lead [rad], at most."""
    hand_command: float
    """The command before this step [m]."""
    action: float
    """The change of it that the policy wanted [m]; NaN if it was not heard."""
    command: float
    """The command of this step [m]: the same as before when the hands are held."""
    hold: str
    """Why the hands are held, empty if they are not."""
    sensing_age: float
    """Age of the newest motion-capture frame [s]."""
    rate: float
    """Motion-capture frames of the last second; infinite in the first."""
    state_time: float
    """What reading the robot took [s]."""
    policy_time: float
    """What the policy took [s], as far as it was waited for."""
    command_time: float
    """What giving the command took [s]."""


@dataclass(kw_only=True)
class Record:
    """A trial as it was played, also one that was stopped."""

    period: float
    """Control period [s]."""
    latency: float
    """Time from the frame that the policy was to be given to the hands' setting out [s]."""
    begin: float = 0.0
    """When the loop began [s], one period before the first step."""
    events: list[Sample | Step] = field(default_factory=list)
    """Frames and steps in the order in which the loop got and made them."""
    late_steps: int = 0
    """Periods that were skipped because the loop came too late for them."""
    stop: Stop | None = None
    """Why the trial was stopped, or None if it was played to its end."""
    reason: str = ""
    """What exactly stopped it."""

    @property
    def start(self) -> float:
        """Time of the first deadline [s]."""
        return self.begin + self.period

    @property
    def samples(self) -> list[Sample]:
        """The motion-capture frames."""
        return [event for event in self.events if isinstance(event, Sample)]

    @property
    def misdated(self) -> int:
        """Number of frames whose time stamps were ahead of the clock, or no numbers."""
        return sum(math.isnan(sample.time) for sample in self.samples)

    @property
    def steps(self) -> list[Step]:
        """The steps."""
        return [event for event in self.events if isinstance(event, Step)]
