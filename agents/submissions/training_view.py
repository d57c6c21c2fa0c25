"""The training view: what a learner of ``training_env`` sees, and what its actions mean.

The wrappers of :mod:`colift.benchmark.environment.wrappers` show it to a learner, and a submission
with ``view`` in its manifest to its network: the same numbers, bit for bit.
"""

from typing import Any, Final

import numpy as np
from colift.agents.actions import action_limit
from colift.agents.agent import Observation
from colift.agents.submissions.network.policy import CORRECTION, FIXED, Senses, line, scales
from colift.base.errors import InputError
from numpy.typing import NDArray

Single = NDArray[np.float32]

PERIOD: Final = 0.1
"""Control period of the suites [s], for the largest change in a step."""

VIEWS: Final = {"training": True, "training-without-pace": False}
"""Names of the views, and whether actions correct the human's last pace: ``training_env()`` and
``training_env(pace=False)``."""


def scaled(numbers: NDArray[np.float64], sizes: NDArray[np.float64]) -> Single:
    """Return numbers divided by their usual sizes, in single precision."""
    found: Single = (numbers / sizes).astype(np.float32)
    return found


def unscaled(action: Any, largest: float) -> NDArray[np.float64]:
    """Return actions in [-1, 1], clipped to that, as changes of up to ``largest``."""
    found: NDArray[np.float64] = largest * np.clip(np.asarray(action, dtype=np.float64), -1.0, 1.0)
    return found


class TrainingView:
    """The view of one learner during a lift: call :meth:`seen` and :meth:`change` in turn.

    Parameters
    ----------
    size
        Numbers of an observation: 7 and one for each step of the human's motion, at least 8.
    pace
        Whether an action corrects, by up to 0.03 m, the change that holds the human's last pace, or
        is the change itself, up to 0.04 m.

    Raises
    ------
    InputError
        If the size is too small.
    """

    def __init__(self, size: int, *, pace: bool = True) -> None:
        if size <= FIXED:
            raise InputError(
                f"the training view has {FIXED} numbers and one for each step, at least "
                f"{FIXED + 1}; got {size}"
            )
        self.steps = size - FIXED
        """Steps of the human's motion."""
        self.largest = CORRECTION if pace else action_limit(PERIOD)
        """The change [m] of an action of 1."""
        self._senses, self._scales = Senses(self.steps), scales(self.steps)
        self._pace, self._line = pace, 0.0

    def reset(self) -> None:
        """Begin a lift: before it, everything stood still."""
        self._senses.reset()
        self._line = 0.0

    def seen(self, observation: Observation) -> Single:
        """Return the observation (size,) of the learner after one more of the robot's."""
        senses = self._senses(observation)
        self._line = line(senses) if self._pace else 0.0
        return scaled(senses, self._scales)

    def change(self, action: Any) -> NDArray[np.float64]:
        """Return the change of the hands' height [m] that the learner's action means."""
        return unscaled(action, self.largest) + self._line
