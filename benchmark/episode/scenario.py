"""A scenario: behaviour, subject, partner, task and timing of an episode."""

from dataclasses import dataclass
from typing import Final

from colift.agents.agent import FRAME
from colift.agents.humans import Behaviour, Recorded, Subject
from colift.agents.humans.person import Attentive, Person
from colift.base.errors import InputError
from colift.benchmark.episode.conditions import Conditions
from colift.benchmark.episode.seat import Seat, make_seat
from colift.benchmark.episode.task import Task
from colift.benchmark.robots.robot import DEFAULT_ROBOT

CONTROL_PERIOD: Final = 0.1
"""Default control period [s]: the time of one arm movement in the paper (section II.A)."""

LATENCY: Final = 0.1
"""Default age of the motion-capture sample when the robot decides [s]. A choice: the paper states
only that a sample is taken when the last action is complete (section II.A), which reads as 0."""

LONGEST_LATENCY: Final = 0.49
LONGEST_PERIOD: Final = 0.5


@dataclass(frozen=True, kw_only=True)
class Scenario:
    """Everything that defines an episode, except its seed.

    Raises
    ------
    InputError
        If a time is out of range or not a whole number of 10 ms frames.
    """

    behaviour: str
    """Name of the human's behaviour, for tables."""
    human: Behaviour
    """The behaviour: makes the plan of each episode."""
    trial: str = ""
    """Name of the recording, empty for a drawn plan."""
    subject: Subject
    """The human."""
    partner: str = DEFAULT_ROBOT
    """Holder of the robot's end: a robot, or a person of :data:`.HUMANS`."""
    control_period: float = CONTROL_PERIOD
    """Time between two of the robot's decisions [s]."""
    latency: float = LATENCY
    """Age of the motion-capture sample when the robot decides [s]; unused with conditions."""
    conditions: Conditions | None = None
    """Ranges of what is drawn for each lift; None is the benchmark's sensor, table and arms."""
    task: Task
    """The agents' common purpose."""

    def __post_init__(self) -> None:
        """Check the times, and that the task allows conditions."""
        make_seat(self.partner)  # Refuses an unknown name.
        _check_time("control_period", self.control_period, FRAME, LONGEST_PERIOD)
        _check_time("latency", self.latency, 0.0, LONGEST_LATENCY)
        if self.conditions is not None and self.task.touch:
            raise InputError(
                f"conditions are for tasks without touch; the task {self.task.name!r} has it"
            )

    @property
    def rules(self) -> Person:
        """The rules of the person at the near end."""
        human = self.human
        return human.rules if isinstance(human, Attentive) else self.task.person

    @property
    def seat(self) -> Seat:
        """The holder of the robot's end."""
        return make_seat(self.partner)

    @property
    def frames_per_step(self) -> int:
        """Motion-capture frames in one control period."""
        return round(self.control_period / FRAME)

    @property
    def latency_frames(self) -> int:
        """The latency in motion-capture frames."""
        return round(self.latency / FRAME)

    @property
    def person(self) -> str:
        """The person of whom this is one lift: all lifts of a person are one unit in statistics.

        A drawn plan's is the subject. The body of a recorded lift is not that of its person: the
        person is the one that its file names, or if there is none, the recording stands alone.
        """
        recorded = self.human.recording.person if isinstance(self.human, Recorded) else ""
        return recorded or self.trial or self.subject.name

    @property
    def name(self) -> str:
        """Behaviour, subject and trial, such as ``pause/S3``."""
        return f"{self.behaviour}/{self.subject.name}" + (f"/{self.trial}" if self.trial else "")


def _check_time(name: str, value: float, lowest: float, highest: float) -> None:
    frames = value / FRAME
    if not lowest <= value <= highest or abs(frames - round(frames)) > 1e-6:
        raise InputError(
            f"{name} must be a multiple of {FRAME} s in [{lowest}, {highest}] s, got {value}"
        )
