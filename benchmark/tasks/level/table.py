"""The metrics of the task to keep the table level."""

from typing import Final

from colift.benchmark.episode.metric import Metric, MetricWords, metric_table

REACHED: Final = 0.02
"""Distance from the intended height within which the human has reached it [m]."""

MOSTLY_CLIPPED: Final = 0.5
"""Share of clipped actions above which the actions are probably not in metres."""

LEVEL_METRICS: Final = metric_table(
    (
        Metric(
            name="rmse_mm",
            symbol="RMSE",
            label="RMSE",
            unit="mm",
            missing="never",
            shown="board",
            meaning="root mean square of Z1 - Z2 over the whole trial, rest included. The paper's "
            "measure, by which policies are ranked",
            words=MetricWords(
                question="Who keeps the table level?",
                praise=("level", "more level", "most level"),
                axis="RMSE of the height difference, mm",
                plain="how far apart in height the ends of the table are",
                method="How far apart in height the two ends of the table are, over the whole "
                "lift: the root of the mean square difference, a hundred times a second. 0 is a "
                "level table.",
                reading="RMSE: root mean square of the height difference between the two ends of "
                "the table, over the whole lift. Smaller is more level. From a failure on, 250 mm "
                "are counted.",
            ),
        ),
        Metric(
            name="rmse_about_mean_mm",
            symbol="about mean",
            label="RMSE about the mean",
            unit="mm",
            missing="never",
            meaning="the same about the lift's mean of Z1 - Z2: what remains of RMSE without a "
            "constant tilt, which real pairs keep",
        ),
        Metric(
            name="abs_error_mm",
            symbol="error",
            label="Absolute error",
            unit="mm",
            digits=0,
            missing="never",
            meaning="the paper's eq. 10: sum of the absolute difference over all frames",
        ),
        Metric(
            name="max_tilt_deg",
            symbol="tilt",
            label="Tilt",
            unit="°",
            digits=1,
            shown="run",
            meaning="largest incline of the table",
            words=MetricWords(note=""),
        ),
        Metric(
            name="sparc",
            symbol="SPARC",
            label="Smoothness",
            better="more",
            missing="worst",
            shown="board",
            gentle=True,
            meaning="smoothness of the robot's end, mean over the human's strokes: spectral arc "
            "length (20 Hz, threshold 0.05); nearer to zero is smoother",
            words=MetricWords(
                praise=("smooth", "smoother", "smoothest"),
                axis="SPARC",
                plain="smoothness of the robot's end during the human's strokes",
                absent="does not move along",
                present="in which the robot moves along",
                note="smoothness of the robot's end, closer to 0 is smoother",
                reading="SPARC: smoothness of the robot's end during the human's strokes. Closer "
                "to 0 is smoother. A robot that does not move along has no SPARC and counts as "
                "least smooth.",
            ),
        ),
        Metric(
            name="ldlj",
            symbol="LDLJ",
            label="Jerk",
            digits=1,
            better="more",
            missing="worst",
            shown="run",
            meaning="the same by log dimensionless jerk",
            words=MetricWords(note="smoothness of the robot's end, closer to 0 is smoother"),
        ),
        Metric(
            name="rest_speed_mm_s",
            symbol="trembling",
            label="Trembling",
            unit="mm/s",
            digits=1,
            gentle=True,
            meaning="root mean square speed of the robot's end while the human rests, from 0.5 s "
            "after a stroke on",
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
            name="human_work_j",
            symbol="work",
            label="Human work",
            unit="J",
            meaning="integral of the magnitude of that force times the hands' velocity",
        ),
        Metric(
            name="robot_lag_ms",
            symbol="lag",
            label="Lag",
            unit="ms",
            digits=0,
            better="near zero",
            shown="run",
            meaning="delay at which the robot's velocity matches the human's best",
            words=MetricWords(note="of the robot behind the human"),
        ),
        Metric(
            name="short_of_goal_mm",
            symbol="short",
            label="Short of the goal",
            unit="mm",
            digits=1,
            missing="never",
            limit=1000 * REACHED,
            meaning="how far below the intended height the human's end stayed; above 20 mm the "
            "goal was not reached",
        ),
        Metric(
            name="clipped",
            symbol="clipped",
            label="Clipped actions",
            meaning="share of the robot's actions that exceeded the speed of its hands (0.04 m in "
            "100 ms) and were clipped: nearly 1 where millimetres were meant for metres",
        ),
    )
)
"""One entry for each score of :meth:`.Level.score`, in the same order."""
