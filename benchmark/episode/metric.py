"""The table of metrics: the name, presentation and ranking of each score, for every use."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Final, Literal

from colift.base.errors import InputError
from colift.benchmark.episode.drawn import DrawnSeries

LEADING: Final = "rmse_mm"
"""The metric that ranks policies, first in the table of every task: the root mean square of the
task's error [mm], with :data:`.FAILED_FRAME_MM` for each frame that a failure cut off."""

SCORING: Final = 1
"""Version of the scores. Every change to the code of a metric raises it; then the scores of older
bundles are computed again from their actions."""

Scores = Mapping[str, float]
"""One episode's value of each metric by name; NaN where the episode has none."""


@dataclass(frozen=True, kw_only=True)
class MetricWords:
    """A metric in sentences, titles and pictures."""

    question: str = "Who is best?"
    """Title of a board that is ranked by the metric."""
    praise: tuple[str, str, str] = ("good", "better", "best")
    """Positive, comparative and superlative of something with good values."""
    noun: str = ""
    """The metric in a sentence; its label if empty."""
    axis: str = ""
    """Its name on an axis, with the unit; label and unit if empty."""
    plain: str = ""
    """The metric without technical terms, as part of a sentence; its meaning if empty."""
    method: str = ""
    """Its definition for the page on what numbers mean, in sentences; its meaning if empty."""
    absent: str = ""
    """Behaviour of a robot in a lift without a value, as a predicate."""
    present: str = "that have a value"
    """Clause that describes the lifts with a value."""
    note: str | None = None
    """Explanation of its column below a table; its meaning if None, nothing if empty."""
    caption: str = ""
    """The same as a sentence, for headings without units; symbol and unit if empty."""
    reading: str = ""
    """Sentences on how to read it; symbol, meaning and direction if empty."""


@dataclass(frozen=True, kw_only=True)
class Metric:
    """The presentation of one score."""

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
    """Direction of better values."""
    missing: Literal["never", "worst", "left out"] = "left out"
    """Treatment of an episode without a value: it does not occur, it ranks last, or the mean is
    over the other episodes."""
    shown: Literal["board", "run", "file"] = "file"
    """Places with a column: boards, comparisons and a run's table (``board``); a run's table
    (``run``); or only files (``file``). All metrics are in ``results.json`` and
    ``episodes.csv``."""
    gentle: bool = False
    """Whether it shows how gentle an agent is: a policy that is worse by it than two people, beyond
    chance, is marked as rougher; see :func:`.rougher`. Only for ``less`` and ``more``."""
    limit: float | None = None
    """Value above which the episode has missed its goal, if the metric decides that."""
    meaning: str
    """The definition in one sentence."""
    words: MetricWords = MetricWords()
    """Its names in sentences and pictures."""

    def __post_init__(self) -> None:
        """Check that it can be compared.

        Raises
        ------
        InputError
            If it shows how gentle an agent is, and its better values have no direction.
        """
        if self.gentle and self.better == "near zero":
            raise InputError(
                f"metric {self.name!r} is gentle, so that better must be 'less' or 'more', "
                f"not {self.better!r}"
            )

    @property
    def heading(self) -> str:
        """Symbol and unit."""
        return f"{self.symbol} {self.unit}".rstrip()

    @property
    def noun(self) -> str:
        """The metric in a sentence."""
        return self.words.noun or self.label[0].lower() + self.label[1:]

    @property
    def axis(self) -> str:
        """Name of an axis, with the unit."""
        return self.words.axis or f"{self.label}, {self.unit}".removesuffix(", ")

    @property
    def plain(self) -> str:
        """The metric without technical terms."""
        return self.words.plain or self.meaning

    @property
    def caption(self) -> str:
        """A sentence with the unit; empty for a pure number."""
        symbol = self.symbol[0].upper() + self.symbol[1:]
        return self.words.caption or (f"{symbol} in {self.unit}." if self.unit else "")

    @property
    def reading(self) -> str:
        """How to read it, in sentences."""
        if self.words.reading:
            return self.words.reading
        which = {"less": "Smaller", "more": "Larger", "near zero": "Closer to 0"}[self.better]
        worst = " A lift without a value counts as the worst." if self.missing == "worst" else ""
        return f"{self.symbol}: {self.meaning}. {which} is {self.words.praise[1]}.{worst}"

    def merit(self, value: float) -> float:
        """Return a number that is larger for better values."""
        return {"less": -value, "more": value, "near zero": -abs(value)}[self.better]

    def text(self, value: float | None) -> str:
        """Return a value as shown in tables."""
        return "none" if value is None else f"{value:.{self.digits}f}"


Metrics = Mapping[str, Metric]
"""A table of metrics by name; the first is :data:`LEADING`."""


class MetricTable(dict[str, Metric]):
    """A table of metrics, with the series that pictures of a lift show."""

    drawn: tuple[DrawnSeries, ...] = ()


def metric_table(metrics: Iterable[Metric], *, drawn: tuple[DrawnSeries, ...] = ()) -> Metrics:
    """Return the metrics by name, in their order.

    Parameters
    ----------
    metrics
        The metrics, the leading one first.
    drawn
        Series that the task adds to a trace, and that pictures of a lift show. Presentation is
        stated here, not in the task's class, so that it changes no digest.
    """
    table = MetricTable({metric.name: metric for metric in metrics})
    table.drawn = drawn
    return table


def drawn_series(metrics: Metrics) -> tuple[DrawnSeries, ...]:
    """Return the added series that pictures of a task's lifts show."""
    return metrics.drawn if isinstance(metrics, MetricTable) else ()


def on_boards(metrics: Metrics) -> tuple[Metric, ...]:
    """Return the metrics that boards and comparisons show beside the leading one."""
    return tuple(
        each for each in metrics.values() if each.shown == "board" and each.name != LEADING
    )


def gentle(metrics: Metrics) -> tuple[Metric, ...]:
    """Return the metrics that show how gentle an agent is."""
    return tuple(each for each in metrics.values() if each.gentle)


def second_axis(metrics: Metrics) -> Metric:
    """Return the metric that pictures show beside the leading one: the first on boards.

    Raises
    ------
    InputError
        If boards show no other metric than the leading one.
    """
    shown = on_boards(metrics)
    if not shown:
        raise InputError(
            f"no metric beside {LEADING} is shown on boards: one of the table "
            f"({', '.join(metrics)}) must have shown='board'"
        )
    return shown[0]


def notes(metrics: Iterable[Metric]) -> str:
    """Return the notes on the columns of some metrics, as sentences; equal notes are joined."""
    said: dict[str, list[str]] = {}
    for metric in metrics:
        note = metric.meaning if metric.words.note is None else metric.words.note
        said.setdefault(note, []).append(metric.symbol)
    return " ".join(f"{', '.join(symbols)}: {note}." for note, symbols in said.items() if note)


def reached(scores: Scores, metrics: Metrics) -> bool:
    """Return whether an episode reached its goal; True if that is unknown."""
    return not any(
        metric.limit is not None and scores[metric.name] > metric.limit
        for metric in metrics.values()
    )
