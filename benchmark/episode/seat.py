"""The seat at the robot's end: taken by a NAO or by a second human."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Final, Protocol

import numpy as np
from colift.agents.actions import action_limit
from colift.agents.agent import Observation
from colift.agents.humans import LIVE_SUBJECT, PARTNER_SUBJECT, Subject
from colift.agents.rules import SCALARS, ArrayFunctions, N
from colift.benchmark.episode.task import Playing, Task
from colift.benchmark.world import BodyParameters, FarEnd, HumanFarEnd, NaoFarEnd
from colift.robots.nao.kinematics import STROKE
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


def limited_command(f: ArrayFunctions[N], command: N, change: N, limit: float) -> N:
    """Return the hand command [m] after a step: clipped to the hands' speed, then to their stroke.

    Parameters
    ----------
    command
        The command before the step [m].
    change
        The action, a change of the command [m].
    limit
        The largest change in one step [m]; see :func:`action_limit`.
    """
    return f.clip(command + f.clip(change, -limit, limit), *STROKE)


def hand_commands(actions: ArrayLike, control_period: float) -> NDArray[np.float64]:
    """Return the hand command at the end of each step [m], shape (m,).

    Parameters
    ----------
    actions
        Changes of the command [m] as the policy gave them, shape (m, 1); they are clipped to the
        hand's speed and stroke, as in the episode.
    control_period
        Time of a step [s].
    """
    limit, command, found = action_limit(control_period), 0.0, []
    for change in np.asarray(actions, dtype=np.float64).ravel().tolist():
        command = limited_command(SCALARS, command, change, limit)
        found.append(command)
    return np.array(found)


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

    def observation(self, task: Task, lift: Playing) -> Observation:
        """Return the holder's observation at the beginning of a step."""

    def clipped(self, actions: NDArray[np.float64], limit: float) -> float:
        """Return the share of actions larger than ``limit`` [m]; NaN if none was made or counts."""


class NaoSeat:
    """A NAO: an action is one number, the change of the hand command over the step [m]."""

    label: Final = "robot"
    is_robot: Final = True
    body: Final = NaoFarEnd()
    person: Final = None

    def action_size(self, frames: int) -> int:
        """Return 1."""
        return 1

    def action_range(self, control_period: float) -> tuple[float, float]:
        """Return the largest change of the command in one period, down and up [m]."""
        limit = action_limit(control_period)
        return -limit, limit

    def commands(self, lift: Playing, action: list[float]) -> Sequence[float]:
        """Return a ramp from the present command, clipped to the hands' speed and stroke."""
        start, size = lift.command, lift.frames_per_step
        change = limited_command(SCALARS, start, action[0], lift.step_limit) - start
        return [start + change * (i + 1) / size for i in range(size)]

    def observation(self, task: Task, lift: Playing) -> Observation:
        """Return the task's observation of the robot."""
        return task.robot_observation(lift)

    def clipped(self, actions: NDArray[np.float64], limit: float) -> float:
        """Return the share of changes that were faster than the hands."""
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

    def observation(self, task: Task, lift: Playing) -> Observation:
        """Return the task's observation of a second human."""
        return task.partner_observation(lift)

    def clipped(self, actions: NDArray[np.float64], limit: float) -> float:
        """Return NaN: a person's references have no limit of speed."""
        return math.nan


SEATS: Final[Mapping[str, Seat]] = {
    "nao": NaoSeat(),
    "human": HumanSeat(person=PARTNER_SUBJECT),
    "live": HumanSeat(person=LIVE_SUBJECT),
}
"""The holders of the robot's end by name: a NAO, the simulated second human, and a real one."""
