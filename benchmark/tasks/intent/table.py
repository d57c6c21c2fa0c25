"""The metrics of the task to bring the table to an intended pose."""

from typing import Final

from colift.benchmark.episode.drawn import DrawnSeries
from colift.benchmark.episode.metric import Metric, MetricWords, metric_table

INTENT_METRICS: Final = metric_table(
    (
        Metric(
            name="rmse_mm",
            symbol="RMSE",
            label="RMSE of the pose",
            unit="mm",
            missing="never",
            shown="board",
            meaning="root mean square distance of both ends from their intended heights over the "
            "whole trial, by which policies are ranked; each frame of the plan that is not done at "
            "the end counts with 250 mm",
            words=MetricWords(
                question="Who finds the pose that the human intends?",
                praise=("accurate", "more accurate", "most accurate"),
                plain="how far both ends of the table are from where the human intends them",
            ),
        ),
        Metric(
            name="settling_ms",
            symbol="settling",
            label="Time to the right pose",
            unit="ms",
            digits=0,
            missing="worst",
            shown="board",
            meaning="time from the beginning of a movement until the robot's end stays within "
            "10 mm of its intended height, mean over the movements",
            words=MetricWords(
                praise=("quick", "quicker", "quickest"),
                plain="time until the robot's end is where the human intends it",
                absent="fails",
                present="that did not fail",
                note="until the robot's end stays within 10 mm of where it should be",
            ),
        ),
        Metric(
            name="finished",
            symbol="finished",
            label="Share of the plan done",
            better="more",
            missing="never",
            shown="board",
            meaning="share of the plan that person and robot have gone through at the end, to the "
            "frame in which the table is down; less if the person still waits, or if an end is "
            "more than 50 mm above the ground",
            words=MetricWords(
                noun="share of the plan done",
                plain="how much of what the human intended was done in time",
                note="share of the plan that was done at the end of the lift",
                caption="Finished: share of the plan done.",
            ),
        ),
        Metric(
            name="peak_mm",
            symbol="wrong",
            label="Cost of wrong guesses",
            unit="mm",
            digits=1,
            missing="worst",
            shown="run",
            meaning="largest distance of the robot's end from its intended height in a movement, "
            "mean over the movements",
            words=MetricWords(note="largest distance of the robot's end from there in a movement"),
        ),
        Metric(
            name="near_rmse_mm",
            symbol="own end",
            label="RMSE of the human's end",
            unit="mm",
            digits=1,
            meaning="root mean square distance of the human's end from its intended height",
        ),
        Metric(
            name="max_tilt_deg",
            symbol="tilt",
            label="Tilt",
            unit="°",
            digits=1,
            better="near zero",
            meaning="largest incline of the table; poses are inclined by up to 12°",
        ),
        Metric(
            name="human_force_n",
            symbol="force",
            label="Human force",
            unit="N",
            shown="board",
            gentle=True,
            meaning="root mean square of the vertical force at the human's hands, beyond their "
            "half of the table's weight",
            words=MetricWords(
                noun="force",
                note="at the human's hands",
                caption="Force at the human's hands in N.",
            ),
        ),
        Metric(
            name="opposing_work_j",
            symbol="work",
            label="Work against the robot",
            unit="J",
            shown="run",
            meaning="work that the human's hands do with that force in the direction in which "
            "they move",
            words=MetricWords(note="of the human's hands against the robot"),
        ),
        Metric(
            name="clipped",
            symbol="clipped",
            label="Clipped actions",
            meaning="share of the robot's actions that exceeded the speed of its hands (0.04 m in "
            "100 ms) and were clipped",
        ),
    ),
    drawn=(DrawnSeries(name="far_target", label="intended far end", goal=True),),
)
"""One entry for each score of :meth:`.Intent.score`, in the same order."""
