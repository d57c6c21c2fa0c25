"""Scores beside those of the recorded pairs themselves, in the same part of the same lifts."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metrics import rmse_mm
from colift.benchmark.execution.runner import Run
from colift.benchmark.pairs.coordination import coordination
from colift.benchmark.pairs.recorded import PairLift
from colift.benchmark.pairs.simulated import played_frames
from colift.benchmark.statistics import FloatArray, Units, geometric_ratio, mean_of
from colift.benchmark.suites.suite import Suite
from colift.benchmark.validity.quantity import Quantity


@dataclass(frozen=True, kw_only=True, eq=False)
class BesidePairs:
    """RMSE of recorded pairs, and of policies where they played the pairs' movements [mm]."""

    units: Units = field(repr=False)
    """The people of the n lifts of which both ends were recorded."""
    pairs: FloatArray = field(repr=False)
    """RMSE of the pair in each lift, shape (n,)."""
    errors: Mapping[str, FloatArray] = field(repr=False)
    """RMSE of each policy, and of :data:`.HUMAN_HUMAN`, while the recording is played, shape (n,).

    Rests and the return are not part of it, as they are not of the recording.
    """

    @property
    def pairs_mm(self) -> Quantity:
        """Mean RMSE of the recorded pairs."""
        return Quantity.of(mean_of(self.pairs, self.units))

    def ratio(self, name: str) -> Quantity:
        """Return the ratio of a policy's RMSE to that of the recorded pairs, geometric mean."""
        return Quantity.of(geometric_ratio(self.errors[name], self.pairs, self.units))


def beside_pairs(
    suite: Suite, units: Units, lifts: Mapping[str, PairLift], runs: Mapping[str, Run]
) -> BesidePairs | None:
    """Return the scores beside those of recorded pairs; None if there are too few for an interval.

    Parameters
    ----------
    suite
        Movements at their own height and pace.
    units
        The people of its lifts.
    lifts
        The recorded lifts with both ends, by trial.
    runs
        What the policies and the simulated two people have played, by name.
    """
    known = [i for i, scenario in enumerate(suite.scenarios) if scenario.trial in lifts]
    of_pairs = units.select(known)
    if not known or of_pairs.freedom == 0:
        return None
    frames = [played_frames(suite.scenarios[i], suite.seeds[0]) for i in known]
    names = [suite.scenarios[i].trial for i in known]
    return BesidePairs(
        units=of_pairs,
        pairs=np.array([coordination(lifts[name].ends).rmse_mm for name in names]),
        errors={
            name: np.array(
                [_error(run.episodes[i], part) for i, part in zip(known, frames, strict=True)]
            )
            for name, run in runs.items()
        },
    )


def _error(episode: Episode, frames: slice) -> float:
    ends = episode.trace.human_end[frames], episode.trace.robot_end[frames]
    return rmse_mm(*ends, horizon=frames.stop - frames.start)
