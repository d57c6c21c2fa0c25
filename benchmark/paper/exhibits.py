"""Claims and figures of the report."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

from colift.benchmark.rendering.style import LINE
from matplotlib.axes import Axes
from matplotlib.figure import Figure

OUTSIDE = "The measured value lies outside the criterion."


@dataclass(frozen=True, kw_only=True)
class Claim:
    """A statement of the paper with a measured answer."""

    claim: str
    """The statement, in words."""
    figure: str
    """The report's figure or table with the evidence."""
    paper: str
    """The paper's result."""
    criterion: str
    """Condition under which it holds."""
    measured: str
    """Our result, in words and numbers."""
    values: Mapping[str, float | None] = field(default_factory=dict)
    """The numbers of ``measured``, units in the names."""
    holds: bool
    fitted: bool = False
    """Whether numbers of the set-up were fitted to it, so that it is no independent finding."""
    note: str = ""
    """Reasons in the data, or limits of the answer; never empty if the claim does not hold."""

    def __post_init__(self) -> None:
        """Give a claim that does not hold a note, if it has none."""
        if not self.holds and not self.note:
            object.__setattr__(self, "note", OUTSIDE)


def p_value_text(p: float) -> str:
    """Return a p value as text; its floor is the number of resamples."""
    return f"p = {p:.4f}" if p >= 0.00015 else "p < 0.0002"


STEPS: Final = "time step (100 ms)"
"""Axis of the steps of a lift."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Exhibit:
    """A figure of the report."""

    name: str
    """Name of its files, such as ``figure-4``."""
    title: str
    caption: str
    """Content of the figure, and the point to note."""
    figure: Figure
    columns: Mapping[str, Sequence[float | str] | Sequence[float]]
    """The data, column by column, units in the names."""


def shade(axes: Axes, spans: Sequence[tuple[float, float]], label: str = "") -> None:
    """Shade spans of the horizontal axis; one of them carries the label."""
    for index, (start, stop) in enumerate(spans):
        axes.axvspan(
            start, stop, color=LINE, alpha=0.45, lw=0, label=label if index == 0 and label else None
        )
