"""The oracle of intended poses: it knows the human's plan for both ends."""

import numpy as np
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.trace import Trace
from colift.benchmark.tasks.rehearsal import rehearse_lift
from numpy.typing import NDArray


def foreknow_pose(lift: Lift, seed: int) -> Episode:
    """Return the episode of a seed, played by the oracle; see :func:`.rehearse_lift`."""

    def planned(lift: Lift) -> NDArray[np.float64]:
        return np.asarray(lift.due.far)

    def missed(trace: Trace) -> NDArray[np.float64]:
        return np.asarray(trace.added["far_target"] - trace.robot_end)

    return rehearse_lift(lift, seed, planned, missed)
