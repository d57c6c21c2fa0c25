"""A lift with a human who intends a pose of the whole table."""

from collections.abc import Sequence

import numpy as np
from colift.agents.agent import Observation
from colift.agents.humans.intent import (
    PaceMemory,
    PaceSenses,
    PosePath,
    PosePlan,
    intended,
    leading_manner,
    pace,
)
from colift.agents.rules import SCALARS, NumberSeries
from colift.benchmark.tasks.haptic import HapticLift
from colift.benchmark.world import Intended
from colift.benchmark.world.table import TABLE_LENGTH


class IntentLift(HapticLift):
    """A lift whose human also has an intended height for the far end.

    The human goes through the plan at a variable pace (:func:`.pace`). The human's reflexes
    correct deviations from the intended height difference, and the wrists turn with the intended
    pitch according to the person's manner (:func:`.intended`).
    """

    def reset(self, seed: int) -> None:
        """Begin the episode ``seed``, as :meth:`.HapticLift.reset`."""
        super().reset(seed)
        plan = self.plan
        far = plan.far if isinstance(plan, PosePlan) else plan.target
        self.far_target = np.concatenate((far, np.full(self.horizon - len(far), far[-1])))
        """(horizon,) the planned height of the far end at the end of each frame [m]."""
        self._manner = leading_manner(self.scenario.subject)
        self._path = PosePath(NumberSeries.of(self.target), NumberSeries.of(self.far_target))
        self._pace = PaceMemory(0.0, 0.0)
        self._planned = [0.0] * (1 + self._human_delays[0])
        self._plan_ahead()

    def end(self, command: float) -> None:
        """End the control period; see :meth:`.Lift.end`."""
        super().end(command)
        self._plan_ahead()

    def intended(self) -> Observation:
        """Return the human's intended height at the end of each frame of the coming step [m]."""
        return np.array([pose.near for pose in self._poses])

    def _plan_ahead(self) -> None:
        """Determine the intentions of the coming step."""
        seen = -1 - self._human_delays[0]
        senses = PaceSenses(self.world.robot_end[seen], self._planned[seen])
        self._pace, times = pace(SCALARS, self._manner, self._pace, senses, self.frames_per_step)
        self._poses = [
            intended(SCALARS, self._manner, self._path, time, TABLE_LENGTH) for time in times
        ]
        self._planned += [pose.far for pose in self._poses]
        self._moved = 0

    def intended_in(self, human: Sequence[float]) -> Intended:
        """Return the person's intention in the frames of some hand references."""
        poses = self._poses[self._moved : self._moved + len(human)]
        self._moved += len(human)
        return [pose.far - pose.near for pose in poses], [pose.pitch for pose in poses]
