"""The interface of tasks: observations, rewards, end and scores of an episode."""

from collections.abc import Mapping
from typing import Protocol

import numpy as np
from colift.agents.agent import Observation
from colift.agents.humans import Plan
from colift.benchmark.episode.metric import Metrics, Scores
from colift.benchmark.episode.trace import Trace
from colift.benchmark.world import BodyParameters, FarEnd, Physics, World
from numpy.typing import NDArray

Bounds = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Lowest and highest value of each number of an observation."""


class Playing(Protocol):
    """A lift in progress, as seen by tasks and seats; :class:`.Lift` is the implementation."""

    world: World
    """The physical world, with its read-outs."""
    frames_per_step: int
    """Motion-capture frames per control period."""
    step_limit: float
    """Largest change of a robot's hand command in one step [m]."""
    plan: Plan
    """The human's private plan."""
    target: NDArray[np.float64]
    """(horizon,) the human's intended height at the end of each frame [m]."""
    horizon: int
    """Frames of the episode."""
    frame: int
    """Frames since its beginning."""
    command: float
    """The robot's hand command [m]."""

    def role_seed(self, role: str) -> int:
        """Return the episode's seed of a role such as ``"sensor"``."""

    def robot_view(self) -> Observation:
        """Return the robot's senses, laid out as :class:`.RobotObservation`."""

    def human_view(self, target: Observation) -> Observation:
        """Return the human's senses, laid out as :class:`.HumanObservation`, with a target [m]."""

    def partner_view(self, target: Observation) -> Observation:
        """Return the same for a second human at the robot's end."""

    def seen_by_partner(self) -> float:
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

    def world(self, human: BodyParameters, far_end: FarEnd, *, physics: Physics = ...) -> World:
        """Return a world of a person and a holder of the far end, with the task's own physics by
        default."""

    def robot_observation(self, lift: Playing) -> Observation:
        """Return the robot's observation at the beginning of a step."""

    def human_observation(self, lift: Playing) -> Observation:
        """Return the human's observation at the beginning of a step."""

    def partner_observation(self, lift: Playing) -> Observation:
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
