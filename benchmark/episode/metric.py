"""The table of metrics: how each score is named, shown and ranked, wherever it is shown."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Final, Literal

LEADING: Final = "rmse_mm"
"""The metric that ranks policies, first in the table of every task: the root mean square of the
task's error [mm], with :data:`.FAILED_FRAME_MM` for each frame that a failure cut off."""

SCORING: Final = 1
"""Version of the scores. Every change to the code of a metric raises it; then the scores of older
bundles are computed again from their actions."""

Scores = Mapping[str, float]
"""One episode's value of each metric by name; NaN where the episode has none."""


@dataclass(frozen=True, kw_only=True)
class Metric:
    """How one score is shown."""

    name: str
    """Key in JSON and CSV."""
    symbol: str
    """Heading of a column."""
    label: str
    """The metric in words."""
    unit: str = ""
    """Unit; empty for a pure number."""
    digits: int = 2
    """Decimals in a table."""
    better: Literal["less", "more", "near zero"] = "less"
    """Which values are better."""
    missing: Literal["never", "worst", "left out"] = "left out"
    """What an episode without a value means: it does not occur, it ranks last, or the mean is over
    the other episodes."""
    shown: Literal["board", "run", "file"] = "file"
    """Where it has a column: on boards, in comparisons and in a run's table; in a run's table; only
    in files. All are in ``results.json`` and ``episodes.csv``."""
    limit: float | None = None
    """Value above which the episode has missed its goal, if the metric decides that."""
    meaning: str
    """The definition in one sentence."""

    @property
    def heading(self) -> str:
        """Symbol and unit."""
        return f"{self.symbol} {self.unit}".rstrip()

    def text(self, value: float | None) -> str:
        """Return a value as tables show it."""
        return "none" if value is None else f"{value:.{self.digits}f}"


Metrics = Mapping[str, Metric]
"""A table of metrics by name; the first is :data:`LEADING`."""


def metric_table(metrics: Iterable[Metric]) -> Metrics:
    """Return the metrics by name, in their order."""
    return {metric.name: metric for metric in metrics}


def on_boards(metrics: Metrics) -> tuple[Metric, ...]:
    """Return the metrics that boards and comparisons show beside the leading one."""
    return tuple(
        each for each in metrics.values() if each.shown == "board" and each.name != LEADING
    )


def reached(scores: Scores, metrics: Metrics) -> bool:
    """Return whether an episode reached its goal; True if that is unknown."""
    return not any(
        metric.limit is not None and scores[metric.name] > metric.limit
        for metric in metrics.values()
    )
