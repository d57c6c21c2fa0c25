"""Pose by Bayes: the intended pose, inferred from the human's motion, force and waiting."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.agents.ranges import NotNegative, Positive, Probability, check_ranges
from colift.agents.tasks.intent.pose_filter import PoseFilter, PoseFilterParameters
from colift.agents.tasks.touch.observation import HapticObservation
from colift.agents.tasks.touch.touched import touched


@dataclass(frozen=True, kw_only=True)
class PoseByBayesParameters:
    """Parameters of :class:`PoseByBayes`, tuned on seeds from 100000 on and on no suite."""

    ahead: NotNegative = 0.12
    """Time by which the command is planned ahead [s], for the lag of the arm."""
    switch: Probability = 0.03
    """See :class:`.PoseFilterParameters`."""
    pitch_noise: Positive = 0.012
    """See :class:`.PoseFilterParameters` [rad]."""
    path_noise: Positive = 0.1
    """See :class:`.PoseFilterParameters`."""
    haste: Probability = 0.1
    """See :class:`.PoseFilterParameters`; a value of 1 ignores whether the human waits."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


class PoseByBayes:
    """Goes to the height that the human probably intends for the robot's end (ours).

    A :class:`.PoseFilter` uses the pitch and the human's end, which follow from the torque without
    delay, and the force, which depends on the human's wrists. With the expected height f, the
    expected ratio r of the ends' movements and the velocity v of the human's end, the command
    becomes

        u = f + r v ahead.
    """

    def __init__(self, *, parameters: PoseByBayesParameters | None = None) -> None:
        p = parameters or PoseByBayesParameters()
        self._ahead = p.ahead / DEFAULT_PERIOD
        self._filter = PoseFilter(
            PoseFilterParameters(
                switch=p.switch,
                pitch_noise=p.pitch_noise,
                path_noise=p.path_noise,
                haste=p.haste,
            )
        )

    def reset(self, seed: int) -> None:
        """Begin an episode with a level table at rest."""
        self._filter.reset()
        self._near = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the change [m] that brings the command to the expected height."""
        table = touched(observation)
        self._filter.update(table.near, table.pitch, table.force)
        change, self._near = table.near - self._near, table.near
        command = self._filter.height + self._filter.share * change * self._ahead
        return np.array([command - observation[HapticObservation.HAND_COMMAND]])

    def internals(self) -> dict[str, float]:
        """Return the expected height of the robot's end [m], and the probability of each intent."""
        together, pivot, counter = self._filter.intents.tolist()
        height = self._filter.height
        return {"height": height, "together": together, "pivot": pivot, "counter": counter}
