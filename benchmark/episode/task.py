"""The interface of tasks: observations, rewards, end and scores of an episode."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from colift.agents.agent import Observation
from colift.agents.humans import Plan
from colift.agents.humans.person import Person
from colift.agents.rules import ArrayFunctions, Drawn, N, View
from colift.agents.senses import Sense
from colift.benchmark.episode.metric import Metrics, Scores
from colift.benchmark.episode.trace import Trace
from colift.benchmark.world.human_body import BodyParameters
from colift.benchmark.world.interface import FarEnd, World
from colift.benchmark.world.physics import Physics
from colift.benchmark.world.table import TABLE, Table
from numpy.typing import NDArray

Bounds = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Lowest and highest value of each number of an observation."""


class Playing(Protocol):
    """A lift in progress, as seen by tasks and seats; :class:`.Lift` is the implementation."""

    world: World
    """The physical world, with its read-outs."""
    frames_per_step: int
    """Motion-capture frames per control period."""
    table: Table
    """The table."""
    plan: Plan
    """The human's private plan."""
    target: NDArray[np.float64]
    """(horizon,) the human's intended height at the end of each frame [m]."""
    horizon: int
    """Frames of the episode."""
    step_limit: float
    """Largest change of a robot's hand command in one step [m]."""
    frame: int
    """Frames since its beginning."""
    command: float
    """The robot's hand command [m]."""
    visual: int
    """The human's visual delay in frames."""
    haptic: int
    """The human's haptic delay in frames."""
    partner_visual: int
    """That of a second human."""
    due: Any
    """The task's series, arrays (horizon,)."""
    facts: Any
    """The task's numbers."""
    drawn: Drawn[float]
    """Plan, series and numbers, as rules read them."""
    intention: Any
    """The person's intention in the coming step; see :meth:`.Person.intend`."""

    @property
    def latency(self) -> int:
        """Age of the motion capture's sample in frames."""

    @property
    def hand(self) -> float:
        """Height of the hands at the far end by their encoders [m]."""

    def role_seed(self, role: str) -> int:
        """Return the episode's seed of a role such as ``"sensor"``."""

    def seen(self, name: str, age: int) -> float:
        """Return a past read-out; see :meth:`.View.seen`."""

    def robot_view(self) -> Observation:
        """Return the robot's senses: sight, touch, and the task's own."""

    def human_view(self, target: Observation) -> Observation:
        """Return the human's senses, laid out as :class:`.HumanObservation`, with a target [m]."""

    def second_person_view(self, target: Observation) -> Observation:
        """Return the same for a second human at the robot's end."""

    def planned(self) -> Observation:
        """Return the planned height of the human's end in each frame of the coming step [m]."""

    def seen_by_second_person(self) -> float:
        """Return the height of the human's end [m] that a second human sees."""

    def clipped(self, actions: NDArray[np.float64]) -> float:
        """Return the share of actions beyond the hands' speed; NaN for a second human."""


class Task(Protocol):
    """The agents' common purpose; :class:`.Level` is the task of the paper.

    A task is a frozen dataclass: its fields and the code of its class are in the digest of every
    suite that plays it. It is stateless; everything that changes during an episode is in the lift.
    Most tasks subclass :class:`.Level` and override the methods that differ.
    """

    @property
    def name(self) -> str:
        """Name of its entry point in the group ``colift.tasks``."""

    @property
    def metrics(self) -> Metrics:
        """Its metrics by name; the first is the leading one, ``rmse_mm``."""

    @property
    def person(self) -> Person:
        """The people who hold the near end."""

    @property
    def touch(self) -> bool:
        """Whether the robot senses force and torque, and the wrists show an intended pitch."""

    @property
    def physics(self) -> Physics:
        """Time step and solver of its world."""

    @property
    def senses(self) -> tuple[Sense, ...]:
        """The robot's senses besides sight and touch."""

    @property
    def behaviours(self) -> tuple[str, ...]:
        """The behaviours of people in this task, by name: those that learners draw from."""

    def setting(self, plan: Plan, frames: int, seed: Callable[[str], int]) -> tuple[Any, Any]:
        """Return what a lift has besides its plan: a named tuple of series, and one of numbers.

        The series are arrays (frames,), one number per frame; the task's rules and people read
        them as :attr:`.Drawn.series` and :attr:`.Drawn.facts`.

        Parameters
        ----------
        plan
            The human's plan.
        frames
            Frames of the lift.
        seed
            Returns the lift's seed of a role, for what is drawn besides the plan.
        """

    def observe(self, f: ArrayFunctions[N], drawn: Drawn[N], view: View[N]) -> Sequence[N]:
        """Return the robot's own senses in this task without their errors."""

    def world(
        self,
        human: BodyParameters,
        far_end: FarEnd,
        table: Table = TABLE,
        *,
        physics: Physics | None = None,
    ) -> World:
        """Return a world of a person, a holder of the far end, and a table; with its physics."""

    def robot_observation(self, lift: Playing) -> Observation:
        """Return the robot's observation at the beginning of a step."""

    def human_observation(self, lift: Playing) -> Observation:
        """Return the human's observation at the beginning of a step."""

    def second_person_observation(self, lift: Playing) -> Observation:
        """Return the observation of a second human in the robot's place."""

    def robot_bounds(self) -> Bounds:
        """Return the bounds of :meth:`robot_observation`."""

    def human_bounds(self, frames: int) -> Bounds:
        """Return the bounds of the two humans' observations, for ``frames`` frames per step."""

    def rewards(self, lift: Playing) -> tuple[float, float]:
        """Return the rewards of the human and of the robot for the step just made."""

    def failure(self, lift: Playing) -> str | None:
        """Return the reason why the episode ends after the step just made, or None."""

    def series(self, lift: Playing) -> Mapping[str, NDArray[np.float64]]:
        """Return the series that the task adds to a trace, (n,) each, one number per frame."""

    def score(self, lift: Playing, trace: Trace, *, failed: bool) -> Scores:
        """Return the scores of a trace of the lift's current episode, one for each metric."""
