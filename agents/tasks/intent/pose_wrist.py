"""Pose by the wrists: the table goes to the pitch at which the human's wrists relax."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.ranges import Positive, check_ranges
from colift.agents.tasks.touch.observation import HapticObservation
from colift.agents.tasks.touch.touched import FAR_STIFFNESS, TABLE_LENGTH, WRIST_STIFFNESS, touched


@dataclass(frozen=True, kw_only=True)
class PoseByWristParameters:
    """Parameters of :class:`PoseByWrist`."""

    shown: Positive = 1.02
    """Share of an intended pitch that the wrists are assumed to show. It is more than most people
    show: a table that leans too little is better than one that leans too much."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


class PoseByWrist:
    """Takes the torque of the human's wrists as an exact measure of the intended pitch (ours).

    The pitch w that the wrists turn towards follows from statics (:class:`.PoseFilter`). With the
    height z and the last change d of the human's end, and the table's length L, the command becomes

        u = z + d + L w / shown.

    This is right for a person whose wrists show just that share; for others it is too little or too
    much.
    """

    def __init__(self, *, parameters: PoseByWristParameters | None = None) -> None:
        self._gain = TABLE_LENGTH / (parameters or PoseByWristParameters()).shown

    def reset(self, seed: int) -> None:
        """Begin an episode with the table at height 0."""
        self._near = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the change [m] that brings the command to the height for the wrists' pitch."""
        table = touched(observation)
        torque = FAR_STIFFNESS * table.pitch - table.force * TABLE_LENGTH
        wrist = table.pitch + torque / WRIST_STIFFNESS
        change, self._near = table.near - self._near, table.near
        command = table.near + change + self._gain * wrist
        return np.array([command - observation[HapticObservation.HAND_COMMAND]])
