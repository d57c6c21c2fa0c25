"""An exported lift: both agents' observations, actions and rewards, step by step."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class AgentView:
    """One agent's part of a lift of m steps."""

    observations: Array
    """(m + 1, k) the observation before each step, and the one after the last."""
    actions: Array
    """(m, j) the action of each step."""
    rewards: Array
    """(m,) the reward of each step [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ExportedLift:
    """One lift of a data set."""

    scenario: str
    """Behaviour, subject and trial, such as ``pause/draw-120001``."""
    behaviour: str
    subject: str
    trial: str
    """Name of the recording, empty for a drawn plan."""
    seed: int
    policy: str
    """The agent at the robot's end."""
    robot: AgentView
    human: AgentView | None
    """The human's part; None in a set of the robot alone."""
    dropped: str | None
    """Description of the drop of the table; None if it was not dropped."""
    failure: str | None
    """Reason why the lift ended early: a drop, or an error of the policy; None if it did not."""
    state: str
    """Hash of all actions and states of the lift; see :class:`.Recorder`."""

    @property
    def steps(self) -> int:
        """Number of steps."""
        return len(self.robot.actions)

    @property
    def terminations(self) -> NDArray[np.bool_]:
        """(m,) true in the step that dropped the table, as in the environment."""
        return self._ends(self.dropped is not None)

    @property
    def truncations(self) -> NDArray[np.bool_]:
        """(m,) true in the last step of the horizon, or the last that a failed policy made."""
        return self._ends(self.dropped is None)

    def _ends(self, here: bool) -> NDArray[np.bool_]:
        ends = np.zeros(self.steps, np.bool_)
        ends[-1:] = here
        return ends


@dataclass(frozen=True, kw_only=True, eq=False)
class Spaces:
    """The agents' spaces by name, ``human`` and ``robot``."""

    observations: Mapping[str, Box]
    actions: Mapping[str, Box]
