"""The metrics of the task to steer a ball."""

from typing import Final

from colift.benchmark.episode.drawn import DrawnSeries
from colift.benchmark.episode.metric import Metric, MetricWords, metric_table

BALL_METRICS: Final = metric_table(
    (
        Metric(
            name="rmse_mm",
            symbol="RMSE",
            label="RMSE of the ball",
            unit="mm",
            missing="never",
            shown="board",
            meaning="root mean square distance of the ball from its target over the whole trial, "
            "by which policies are ranked",
            words=MetricWords(
                question="Who brings the ball where it should be?",
                praise=("accurate", "more accurate", "most accurate"),
                plain="how far the ball is from its target",
            ),
        ),
        Metric(
            name="settling_ms",
            symbol="settling",
            label="Time to settle",
            unit="ms",
            digits=0,
            missing="worst",
            shown="board",
            meaning="time from when the target begins to move until the ball stays within 20 mm of "
            "it, mean over the targets",
            words=MetricWords(
                praise=("quick", "quicker", "quickest"),
                plain="time until the ball is where it should be",
                absent="loses the ball",
                present="that did not lose the ball",
                note="until the ball stays within 20 mm of its target",
            ),
        ),
        Metric(
            name="shared_rmse_mm",
            symbol="shared",
            label="RMSE with a shared target",
            unit="mm",
            digits=1,
            shown="board",
            meaning="the RMSE of the lifts in which both know the target",
            words=MetricWords(
                present="whose target both know",
                caption="Shared and private: RMSE in mm of the lifts in which both know the "
                "target, and in which the human alone does.",
            ),
        ),
        Metric(
            name="private_rmse_mm",
            symbol="private",
            label="RMSE with a private target",
            unit="mm",
            digits=1,
            shown="board",
            meaning="the RMSE of the lifts in which the human alone knows the target: the robot "
            "has to infer it",
            words=MetricWords(present="whose target the human alone knows"),
        ),
        Metric(
            name="velocity_peaks",
            symbol="peaks",
            label="Peaks of velocity",
            digits=1,
            missing="worst",
            shown="run",
            meaning="peaks of the ball's speed for each target; one is a single push and brake",
        ),
        Metric(
            name="peak_speed_m_s",
            symbol="peak speed",
            label="Size of the peaks",
            unit="m/s",
            meaning="mean speed of the ball at these peaks",
        ),
        Metric(
            name="fallen",
            symbol="fallen",
            label="Share of balls lost",
            missing="never",
            shown="board",
            meaning="1 if the ball rolled off the table, which ends the lift; its mean is the "
            "share of such lifts",
            words=MetricWords(note="share of lifts whose ball rolled off the table"),
        ),
        Metric(
            name="level_mm",
            symbol="level",
            label="Height difference",
            unit="mm",
            digits=1,
            meaning="root mean square height difference of the table's ends",
        ),
        Metric(
            name="human_force_n",
            symbol="force",
            label="Human force",
            unit="N",
            shown="board",
            gentle=True,
            meaning="root mean square of the vertical force at the human's hands, beyond their "
            "half of the weight of table and ball",
            words=MetricWords(
                noun="force",
                note="at the human's hands",
                caption="Force at the human's hands in N.",
            ),
        ),
        Metric(
            name="clipped",
            symbol="clipped",
            label="Clipped actions",
            meaning="share of the robot's actions that exceeded the speed of its hands (0.04 m in "
            "100 ms) and were clipped",
        ),
    ),
    drawn=(
        DrawnSeries(name="ball", label="ball", where="place"),
        DrawnSeries(name="ball_target", label="target", where="place", goal=True),
    ),
)
"""One entry for each score of :meth:`.BallSteering.score`, in the same order."""
