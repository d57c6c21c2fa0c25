"""A lift with a human who intends a pose of the whole table."""

import math
from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ....agents.agent import FRAME, Agent
from ....agents.intent import Leader, PosePlan, leading_manner
from ....robots.arithmetic import each
from ...world.table import TABLE_LENGTH
from ..haptic import HapticLift

_STEEPEST: Final = 0.5
"""Largest intended pitch's sine; plans stay far inside it."""


class IntentLift(HapticLift):
    """A lift whose human has an intended height for the far end, too.

    The human's reflexes even out what differs from the intended height difference, and the wrists
    turn with the intended pitch, as the person's manner has it (:class:`.LeadingManner`).
    """

    def reset(self, seed: int) -> None:
        """Begin the episode ``seed``, as :meth:`.HapticLift.reset`."""
        super().reset(seed)
        plan = self.plan
        far = plan.far if isinstance(plan, PosePlan) else plan.target
        self.far_target = np.concatenate((far, np.full(self.horizon - len(far), far[-1])))
        """(horizon,) the intended height of the far end at the end of each frame [m]."""
        manner = leading_manner(self.scenario.subject)
        difference = self.far_target - self.target
        sine = np.clip(difference / TABLE_LENGTH, -_STEEPEST, _STEEPEST)
        pitch = manner.wrist * each(math.asin, sine)
        self._differences: list[float] = difference.tolist()
        self._pitches: list[float] = _earlier(pitch, round(manner.lead / FRAME)).tolist()
        self._moved = 0

    def scripted_human(self) -> Agent:
        """Return the person who leads the table through the plan, reset for the episode."""
        human = Leader(subject=self.scenario.subject)
        human.reset(self.role_seed("human"))
        return human

    def move(self, human: Sequence[float], commands: Sequence[float]) -> None:
        """Advance by a frame for each hand reference and command; see :meth:`.Lift.move`."""
        frames = slice(self._moved, self._moved + len(commands))
        self.world.intend(self._differences[frames], self._pitches[frames])
        self._moved += len(commands)
        super().move(human, commands)


def _earlier(series: NDArray[np.float64], frames: int) -> NDArray[np.float64]:
    """Return a series so many frames earlier, or later if negative; its ends stay."""
    places = np.clip(np.arange(len(series)) + frames, 0, len(series) - 1)
    return np.asarray(series[places])
