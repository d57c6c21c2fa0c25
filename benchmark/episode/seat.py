"""The seat at the robot's end: taken by a robot or by a second human."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import ClassVar, Final, Protocol

import numpy as np
from colift.agents.agent import FRAME, Observation
from colift.agents.humans import LIVE_SUBJECT, SECOND_PERSON, Subject
from colift.agents.rules import SCALARS, ArrayFunctions, N
from colift.base.errors import InputError
from colift.base.registry import UnknownNameError
from colift.benchmark.episode.task import Playing, Task
from colift.benchmark.robots.robot import Robot, make_robot, robot_names
from colift.benchmark.world.human_body import BodyParameters
from colift.benchmark.world.interface import FarEnd
from colift.benchmark.world.second_human import HumanFarEnd
from numpy.typing import ArrayLike, NDArray

REFERENCE_RANGE: Final = (-0.2, 0.5)
"""Range of heights to which a human's hand reference is clipped [m]."""


def body_parameters(person: Subject) -> BodyParameters:
    """Return the part of a person that the world simulates."""
    return BodyParameters(
        stiffness=person.stiffness,
        damping=person.damping,
        mass=person.mass,
        pull=person.pull,
        felt_share=person.felt_share,
        visual_delay=person.visual_delay,
        haptic_delay=person.haptic_delay,
    )


def within_range(references: Sequence[float]) -> Sequence[float]:
    """Return a human's references, clipped to the range of heights."""
    low, high = REFERENCE_RANGE
    if min(references) < low or max(references) > high:
        return [min(max(value, low), high) for value in references]
    return references


def limited_command(
    f: ArrayFunctions[N], command: N, change: N, limit: float, stroke: tuple[float, float]
) -> N:
    """Return the hand command [m] after a step: clipped to the hands' speed, then to their stroke.

    Parameters
    ----------
    command
        The command before the step [m].
    change
        The action, a change of the command [m].
    limit
        The largest change in one step [m].
    stroke
        Lowest and highest command [m].
    """
    return f.clip(command + f.clip(change, -limit, limit), *stroke)


class Seat(Protocol):
    """The holder of the robot's end: body, actions and observation."""

    @property
    def label(self) -> str:
        """The holder's name in pictures."""

    @property
    def is_robot(self) -> bool:
        """Whether the holder has the robot's observation, or a human's."""

    @property
    def body(self) -> FarEnd:
        """The holder in the world."""

    @property
    def person(self) -> Subject | None:
        """The second human; None if the holder is a robot."""

    def action_size(self, frames: int) -> int:
        """Return the length of an action, for ``frames`` frames per step."""

    def action_range(self, control_period: float) -> tuple[float, float]:
        """Return the lowest and the highest number of an action [m]."""

    def commands(self, lift: Playing, action: list[float]) -> Sequence[float]:
        """Return the height to reach at the end of each frame of the step [m]."""

    def reached(self, command: float, change: float, control_period: float) -> float:
        """Return the command after a step by a robot's action, both [m]; a person's is kept."""

    def hand_commands(self, actions: ArrayLike, control_period: float) -> NDArray[np.float64]:
        """Return the height to reach at the end of each step (m,), for m actions as given [m]."""

    def observation(self, task: Task, lift: Playing) -> Observation:
        """Return the holder's observation at the beginning of a step."""

    def clipped(self, actions: NDArray[np.float64], control_period: float) -> float:
        """Return the share of actions that were too large; NaN if none was made or counts."""


@dataclass(frozen=True, kw_only=True)
class RobotSeat:
    """A robot: an action is one number, the change of the hand command over the step [m]."""

    body: Robot
    is_robot: ClassVar[bool] = True
    person: ClassVar[None] = None

    @property
    def label(self) -> str:
        """The robot's name in pictures."""
        return self.body.label

    def action_size(self, frames: int) -> int:
        """Return 1."""
        return 1

    def largest_change(self, control_period: float) -> float:
        """Return the largest change of the command in one period [m]."""
        return self.body.hand_speed * control_period

    def action_range(self, control_period: float) -> tuple[float, float]:
        """Return the largest change of the command in one period, down and up [m]."""
        limit = self.largest_change(control_period)
        return -limit, limit

    def reached(self, command: float, change: float, control_period: float) -> float:
        """Return the command after a step [m], clipped to the hands' speed and stroke."""
        limit = self.largest_change(control_period)
        return limited_command(SCALARS, command, change, limit, self.body.stroke)

    def commands(self, lift: Playing, action: list[float]) -> Sequence[float]:
        """Return a ramp from the present command, clipped to the hands' speed and stroke."""
        start, size = lift.command, lift.frames_per_step
        change = self.reached(start, action[0], size * FRAME) - start
        return [start + change * (i + 1) / size for i in range(size)]

    def hand_commands(self, actions: ArrayLike, control_period: float) -> NDArray[np.float64]:
        """Return the command at the end of each step [m], clipped as in the episode."""
        command, found = 0.0, []
        for change in np.asarray(actions, dtype=np.float64).ravel().tolist():
            command = self.reached(command, change, control_period)
            found.append(command)
        return np.array(found)

    def observation(self, task: Task, lift: Playing) -> Observation:
        """Return the task's observation of the robot."""
        return task.robot_observation(lift)

    def clipped(self, actions: NDArray[np.float64], control_period: float) -> float:
        """Return the share of changes that were faster than the hands."""
        limit = self.largest_change(control_period)
        return int((np.abs(actions) > limit).sum()) / len(actions) if len(actions) else math.nan


@dataclass(frozen=True, kw_only=True)
class HumanSeat:
    """A second human: an action is a hand reference for each frame [m]."""

    person: Subject
    label: ClassVar[str] = "partner"
    is_robot: ClassVar[bool] = False

    @property
    def body(self) -> FarEnd:
        """The person's arms."""
        return HumanFarEnd(body_parameters(self.person))

    def action_size(self, frames: int) -> int:
        """Return one number per frame."""
        return frames

    def action_range(self, control_period: float) -> tuple[float, float]:
        """Return the range of heights [m]."""
        return REFERENCE_RANGE

    def commands(self, lift: Playing, action: list[float]) -> Sequence[float]:
        """Return the references, clipped to the range of heights."""
        return within_range(action)

    def reached(self, command: float, change: float, control_period: float) -> float:
        """Return the command: a person has no changes."""
        return command

    def hand_commands(self, actions: ArrayLike, control_period: float) -> NDArray[np.float64]:
        """Return the last reference of each step, clipped to the range of heights [m]."""
        given = np.asarray(actions, dtype=np.float64)
        return given.reshape(len(given), -1)[:, -1:].clip(*REFERENCE_RANGE).ravel()

    def observation(self, task: Task, lift: Playing) -> Observation:
        """Return the task's observation of a second human."""
        return task.second_person_observation(lift)

    def clipped(self, actions: NDArray[np.float64], control_period: float) -> float:
        """Return NaN: a person's references have no limit of speed."""
        return math.nan


HUMANS: Final[Mapping[str, HumanSeat]] = {
    "human": HumanSeat(person=SECOND_PERSON),
    "live": HumanSeat(person=LIVE_SUBJECT),
}
"""The people at the robot's end by name: the simulated second human, and a real one."""


@cache
def make_seat(name: str) -> Seat:
    """Return the holder of the robot's end: a person of :data:`HUMANS`, or a registered robot.

    Raises
    ------
    InputError
        If there is no such person or robot, or the robot cannot be used.
    """
    person = HUMANS.get(name)
    if person is not None:
        return person
    try:
        return RobotSeat(body=make_robot(name))
    except UnknownNameError as error:
        known = ", ".join(map(repr, (*robot_names(), *HUMANS)))
        raise InputError(f"partner must be one of {known}, got {name!r}") from error
