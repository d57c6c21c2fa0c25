"""The metrics of the task to agree on two private hurdles."""

from typing import Final

from colift.agents.agent import FRAME
from colift.benchmark.episode.drawn import DrawnSeries
from colift.benchmark.episode.metric import Metric, MetricWords, metric_table
from colift.benchmark.tasks.agree.scores import STAY

AGREE_METRICS: Final = metric_table(
    (
        Metric(
            name="rmse_mm",
            symbol="RMSE",
            label="RMSE of the agreement",
            unit="mm",
            missing="never",
            shown="board",
            meaning="root mean square of three errors: how far the whole table misses the human's "
            "hurdle and the robot's, and the height difference of its ends at the common height; "
            "hurdles that a lift does not have are left out",
            words=MetricWords(
                question="Who agrees best with a human on two hurdles?",
                praise=("accurate", "more accurate", "most accurate"),
                plain="how far the table misses the heights that both want it to pass, and level",
            ),
        ),
        Metric(
            name="human_hurdle_mm",
            symbol="human's",
            label="Human's hurdle missed",
            unit="mm",
            digits=1,
            shown="board",
            meaning="distance of the table from the human's hurdle in the best 0.2 s of its "
            "window, root mean square of both ends",
        ),
        Metric(
            name="robot_hurdle_mm",
            symbol="robot's",
            label="Robot's hurdle missed",
            unit="mm",
            digits=1,
            shown="board",
            meaning="the same for the robot's hurdle",
        ),
        Metric(
            name="level_mm",
            symbol="level",
            label="Height difference at the common height",
            unit="mm",
            shown="run",
            meaning="root mean square height difference of the ends from the end of the rise to "
            "the beginning of the lowering, while there is something to agree on",
        ),
        Metric(
            name="tilt_mm",
            symbol="tilt",
            label="Height difference of the whole trial",
            unit="mm",
            shown="board",
            meaning="root mean square height difference of the ends over the whole trial",
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
        ),
        Metric(
            name="agreement_ms",
            symbol="agreed",
            label="Time to agree",
            unit="ms",
            digits=0,
            shown="run",
            meaning="time from the opening of the first window until the table has stayed at all "
            "hurdles, for 0.2 s within 10 mm, the end of the window for one that it misses",
        ),
        Metric(
            name="human_leads_mw",
            symbol="human leads",
            label="Human leads",
            unit="mW",
            digits=1,
            better="near zero",
            meaning="mean power of the human's hands less that of the robot's in the 0.3 s before "
            "the human's end crosses the human's hurdle; positive if the human leads",
        ),
        Metric(
            name="robot_leads_mw",
            symbol="robot leads",
            label="Robot leads",
            unit="mW",
            digits=1,
            better="near zero",
            meaning="the same for the robot, its end and its hurdle",
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
        DrawnSeries(name="human_hurdle", label="human's hurdle", where="human", stay=STAY * FRAME),
        DrawnSeries(name="robot_hurdle", label="robot's hurdle", stay=STAY * FRAME),
    ),
)
"""One entry for each score of :meth:`.Agree.score`, in the same order."""
