"""The outcome of an evaluation, for people and programs."""

from dataclasses import dataclass
from importlib import import_module
from typing import Any

from rich.console import RenderableType

from colift.base.errors import InputError
from colift.benchmark.bundle import Results
from colift.benchmark.bundle.table import table_row, treated
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.baselines import HUMAN_HUMAN
from colift.benchmark.tables.failures import reported_failures
from colift.benchmark.tables.printing import text_of
from colift.benchmark.tables.results_table import results_table, results_text


@dataclass(frozen=True, kw_only=True, eq=False)
class Evaluation:
    """Scores of a policy on a suite; ``print`` shows them by human behaviour."""

    run: Run
    """The lifts: ``run.episodes``, each with its scores and its trace."""
    results: Results
    """All numbers; ``results.plain()`` is the content of a bundle's ``results.json``."""

    @property
    def rmse_mm(self) -> float:
        """Mean over the lifts of the RMSE between the table's ends [mm]: less is better."""
        return self.results.summary.rmse_mm.mean

    @property
    def rmse_mm_ci95(self) -> tuple[float, float] | None:
        """95 % confidence interval of :attr:`rmse_mm` [mm]; None with lifts of one person alone."""
        return self.results.summary.rmse_mm.ci95

    @property
    def vs_human(self) -> float:
        """RMSE over that of two people, geometric mean; below 1 is better."""
        ratio = self.results.summary.vs_human
        assert ratio is not None  # Evaluations always have the baselines.
        return ratio.mean

    @property
    def failures(self) -> tuple[str, ...]:
        """The failed lifts with their reasons, one line per lift."""
        return tuple(
            f"{episode.behaviour}/{episode.subject} seed {episode.seed}: {episode.failure}"
            for episode in self.run.episodes
            if episode.failure is not None
        )

    def rows(self) -> list[dict[str, object]]:
        """Return one row per lift, as in ``episodes.csv``: the lift and its scores."""
        suite = self.run.suite
        people = self.results.baselines[HUMAN_HUMAN].lifts_at(self.run.places)
        played = treated(suite)
        return [
            table_row(episode, suite.metrics, played, mm)
            for episode, mm in zip(self.run.episodes, people, strict=True)
        ]

    def to_frame(self) -> Any:
        """Return :meth:`rows` as a ``pandas.DataFrame``.

        Raises
        ------
        InputError
            If pandas is not installed.
        """
        return frame_of(self.rows())

    def __str__(self) -> str:
        """Return the table and the lines below it."""
        return text_of(*self._parts())

    def __repr__(self) -> str:
        """Return policy, suite and error in one line."""
        return (
            f"<Evaluation of {self.run.policy} on {self.run.suite.name}: "
            f"RMSE {self.rmse_mm:.2f} mm, vs_human {self.vs_human:.2f}>"
        )

    def _repr_html_(self) -> str:
        """Return the view of a notebook: the picture, the table and the lines below it."""
        from colift.benchmark.tables.html import html_of
        from colift.picture import evaluation_picture

        return f"{evaluation_picture(self.run, self.results)}\n{html_of(*self._parts())}"

    def _parts(self) -> tuple[RenderableType, ...]:
        """Return the table and the lines below it."""
        metrics = self.run.suite.metrics
        lines = (results_text(self.results, metrics), *reported_failures(self.run))
        return (results_table(self.results, metrics), *lines)


def frame_of(rows: list[dict[str, object]]) -> Any:
    """Return rows as a ``pandas.DataFrame``.

    Raises
    ------
    InputError
        If pandas is not installed.
    """
    try:
        pandas = import_module("pandas")
    except ImportError as error:
        raise InputError("a DataFrame needs pandas: pip install pandas") from error
    return pandas.DataFrame(rows)
