"""The outcome of a comparison, for people and programs."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rich.console import RenderableType

from colift.benchmark.comparison import compare
from colift.benchmark.comparison.captions import failures, remarks, verdict
from colift.benchmark.comparison.ranking import RankedPolicy
from colift.benchmark.comparison.tables import comparison_tables
from colift.benchmark.results.citation import bibtex
from colift.benchmark.tables.printing import text_of
from colift.outcome import frame_of


@dataclass(frozen=True, kw_only=True, eq=False)
class Comparison:
    """Policies ranked on the same lifts; ``print`` shows the tables, a notebook also a picture."""

    content: compare.Comparison
    """All numbers: on all lifts, by behaviour and by subject."""

    @property
    def policies(self) -> tuple[RankedPolicy, ...]:
        """The policies on all lifts, each with its numbers; the least error first."""
        return self.content.overall.policies

    @property
    def bibtex(self) -> str:
        """Entries of BibTeX to cite: colift with the suite, and the paper that it generalises."""
        return bibtex(self.content.results.suite)

    def rows(self) -> list[dict[str, object]]:
        """Return one row per policy on all lifts, and on each part of them, as ``compare.csv``."""
        from colift.benchmark.comparison.files import comparison_rows

        return comparison_rows(self.content)

    def to_frame(self) -> Any:
        """Return :meth:`rows` as a ``pandas.DataFrame``.

        Raises
        ------
        InputError
            If pandas is not installed.
        """
        return frame_of(self.rows())

    def save(self, folder: str | Path, layout: str = "page") -> None:
        """Write the files of ``colift compare --out``: page, tables, figures, LaTeX.

        Parameters
        ----------
        folder
            Where to write; it is made if it is not there.
        layout
            Size of the figures and of the table of LaTeX, as ``--for``: ``"column"``, ``"page"`` or
            ``"slide"``.

        Raises
        ------
        InputError
            If there is no such layout.
        OSError
            If the folder cannot be written to.
        """
        from colift.benchmark.comparison.files import write_comparison
        from colift.benchmark.rendering.layout import find_layout

        write_comparison(Path(folder), self.content, find_layout(layout))

    def __str__(self) -> str:
        """Return the tables and the lines below them."""
        return text_of(*self._parts())

    def __repr__(self) -> str:
        """Return the verdict in one line."""
        return f"<Comparison of {len(self.policies)} policies: {verdict(self.content)}>"

    def _repr_html_(self) -> str:
        """Return the view of a notebook: the picture and the tables."""
        from colift.benchmark.comparison.captions import picture_title
        from colift.benchmark.comparison.ranks_figure import ranks_figure
        from colift.benchmark.rendering.figures import drawn_for, neutral_svg
        from colift.benchmark.rendering.layout import PAGE
        from colift.benchmark.tables.html import html_of

        with drawn_for(PAGE):
            figure = ranks_figure(self.content, PAGE)
        picture = neutral_svg(figure, picture_title(self.content))
        return f"{picture}\n{html_of(*self._parts())}"

    def _parts(self) -> tuple[RenderableType, ...]:
        """Return the tables and the lines below them."""
        content = self.content
        return (*comparison_tables(content), *remarks(content), *failures(content))
