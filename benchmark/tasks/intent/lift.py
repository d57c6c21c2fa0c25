"""A lift with a human who intends a pose of the whole table."""

import math
from collections.abc import Sequence

import numpy as np
from colift.agents.agent import FRAME, Observation
from colift.agents.humans.intent import Pace, PosePlan, leading_manner, planned_at
from colift.benchmark.tasks.haptic import HapticLift
from colift.benchmark.world.table import TABLE_LENGTH


class IntentLift(HapticLift):
    """A lift whose human also has an intended height for the far end.

    The human goes through the plan at a variable pace (:class:`.Pace`). The human's reflexes
    correct deviations from the intended height difference, and the wrists turn with the intended
    pitch according to the person's manner (:class:`.LeadingManner`).
    """

    def reset(self, seed: int) -> None:
        """Begin the episode ``seed``, as :meth:`.HapticLift.reset`."""
        super().reset(seed)
        plan = self.plan
        far = plan.far if isinstance(plan, PosePlan) else plan.target
        self.far_target = np.concatenate((far, np.full(self.horizon - len(far), far[-1])))
        """(horizon,) the planned height of the far end at the end of each frame [m]."""
        self._manner = leading_manner(self.scenario.subject)
        self._pace = Pace(self.scenario.subject, self.far_target)
        self._plan_ahead()

    def end(self, command: float) -> None:
        """End the control period; see :meth:`.Lift.end`."""
        super().end(command)
        self._plan_ahead()

    def intended(self) -> Observation:
        """Return the human's intended height at the end of each frame of the coming step [m]."""
        return np.array([planned_at(self.target, time) for time in self._times])

    def _plan_ahead(self) -> None:
        """Determine the pace of the coming step."""
        self._times = self._pace.coming(self.frames_per_step, self.world.robot_end)
        self._moved = 0

    def move(self, human: Sequence[float], commands: Sequence[float]) -> None:
        """Advance by a frame for each hand reference and command; see :meth:`.Lift.move`."""
        times = self._times[self._moved : self._moved + len(commands)]
        lead = self._manner.lead / FRAME
        differences = [self._difference(time) for time in times]
        pitches = [
            self._manner.wrist * math.asin(self._difference(time + lead) / TABLE_LENGTH)
            for time in times
        ]
        self.world.intend(differences, pitches)
        self._moved += len(commands)
        super().move(human, commands)

    def _difference(self, time: float) -> float:
        """Return the planned height difference [m] at a time within the plan."""
        return planned_at(self.far_target, time) - planned_at(self.target, time)
