"""The seam of tasks: observations, rewards, end and scores of an episode."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from ...agents.agent import Observation
from .metric import Metrics, Scores

if TYPE_CHECKING:
    from .lift import Lift
    from .trace import Trace

Bounds = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Lowest and highest value of each number of an observation."""


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

    def robot_observation(self, lift: "Lift") -> Observation:
        """Return the robot's observation at the beginning of a step."""

    def human_observation(self, lift: "Lift") -> Observation:
        """Return the human's observation at the beginning of a step."""

    def partner_observation(self, lift: "Lift") -> Observation:
        """Return the observation of a second human in the robot's place."""

    def robot_bounds(self) -> Bounds:
        """Return the bounds of :meth:`robot_observation`."""

    def human_bounds(self, frames: int) -> Bounds:
        """Return the bounds of the two humans' observations, for ``frames`` frames per step."""

    def rewards(self, lift: "Lift") -> tuple[float, float]:
        """Return the rewards of the human and of the robot for the step just made."""

    def failure(self, lift: "Lift") -> str | None:
        """Return why the episode ends after the step just made, or None if it goes on."""

    def series(self, lift: "Lift") -> Mapping[str, NDArray[np.float64]]:
        """Return the series that the task adds to a trace, (n,) each, one number per frame."""

    def score(self, lift: "Lift", trace: "Trace", *, failed: bool) -> Scores:
        """Return the scores of a trace of the lift's current episode, one for each metric."""
