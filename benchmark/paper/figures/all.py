"""Every figure of the report, and which lift each one shows."""

from collections.abc import Sequence

import numpy as np

from ...episode import Episode
from ..evidence import Evidence
from ..sampled import SampledLift
from ..table_one import TableOne
from ..timing import timing_results
from .confidence import confidence_picture, pause_picture
from .forgetting import forgetting_picture
from .learning import learning_picture
from .picture import Picture
from .prediction import prediction_picture
from .table import table_picture
from .timing import timing_picture
from .trajectories import comparison_picture, error_limit, team_picture


def all_pictures(evidence: Evidence, table: TableOne) -> list[Picture]:
    """Return all figures in the report's order.

    Where a figure shows one lift, it is the one with the median error of its experiment: neither
    the best nor the worst. Figures 4, 5, 8 and 9 show the same lift.
    """
    shown = median_lift([lift.episode for lift in evidence.lifts])
    lift, reactive = evidence.lifts[shown], evidence.reactive.episodes[shown]
    return [
        table_picture(table),
        prediction_picture(lift),
        confidence_picture(lift),
        pause_picture(_median(evidence.pauses)),
        forgetting_picture(_median(evidence.rests)),
        comparison_picture(lift.episode, reactive),
        team_picture(evidence.team.episodes[shown], error_limit(lift.episode, reactive)),
        learning_picture(evidence.learning),
        timing_picture(timing_results(evidence.timing)),
    ]


def median_lift(episodes: Sequence[Episode]) -> int:
    """Return the index of the episode with the (lower) median error."""
    order = np.argsort([episode.scores.rmse_mm for episode in episodes], kind="stable")
    return int(order[(len(order) - 1) // 2])


def _median(lifts: Sequence[SampledLift]) -> SampledLift:
    return lifts[median_lift([lift.episode for lift in lifts])]
