"""The ranks as a figure: a line for each policy, with its error and interval."""

from dataclasses import dataclass
from typing import Final

from colift.benchmark.comparison.compare import Comparison
from colift.benchmark.comparison.formatting import digits
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.style import DASHES, FAINT, HUMAN, INK, PAPER, ROBOT, style_axes
from colift.benchmark.rendering.ticks import far_limit
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL
from colift.benchmark.statistics import Estimate
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

PITCH: Final = 1.4
"""Distance of two lines of names, relative to the size of letters."""

AXIS: Final = 0.45
"""Room for the axis [inches]."""

SQUARE, DIAMOND, CIRCLE = "s", "D", "o"


@dataclass(frozen=True, kw_only=True)
class _Line:
    """A policy, the human-human baseline or a reference."""

    name: str
    rank: str
    error: Estimate
    marker: str
    colour: str
    filled: bool


def ranks_figure(comparison: Comparison, layout: Layout) -> Figure:
    """Return the figure: the least error first, with 95 % intervals and ranks.

    Errors that would squeeze the others are written at the right edge. A slide shows as many of the
    best as it has room for.
    """
    lines = _lines(comparison)
    pitch = PITCH * layout.letters / 72
    room = len(lines) if layout.height is None else int((layout.height - AXIS) / pitch)
    lines, more = lines[:room], lines[room:]
    figure = Figure(figsize=layout.size(AXIS + pitch * len(lines)), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    style_axes(axes)
    axes.grid(visible=False, axis="y")
    people = comparison.overall.human_human_rmse_mm.mean
    axes.axvline(people, color=HUMAN, lw=1.0, ls=DASHES, zorder=1)
    far = max(far_limit([each.error.mean for each in lines if each.marker == CIRCLE]), people)
    near = [each for each in lines if each.error.mean <= far]
    edge = 1.06 * max(end for each in near for end in each.error.ends)
    for row, each in enumerate(lines):
        if each in near:
            axes.plot(each.error.ends, [row, row], color=each.colour, lw=1.4, clip_on=False)
            axes.plot(
                each.error.mean,
                row,
                each.marker,
                color=each.colour,
                mfc=each.colour if each.filled else PAPER,
                ms=4.5,
                clip_on=False,
            )
        else:
            text = f"{each.error.mean:{digits(each.error.mean)}} \N{RIGHTWARDS ARROW}"
            axes.text(edge, row, text, color=FAINT, ha="right", va="center")
    axes.set_yticks(range(len(lines)), [f"{each.name}  {each.rank:>2}" for each in lines])
    for label, each in zip(axes.get_yticklabels(), lines, strict=True):
        label.set_color({DIAMOND: HUMAN, SQUARE: FAINT}.get(each.marker, INK))
    axes.set_ylim(len(lines) - 0.4, -0.6)
    axes.set_xlim(0, edge)
    rest = f"; {len(more)} more are worse" if more else ""
    axes.set_xlabel(comparison.results.axes[0].axis + rest)
    return figure


def _lines(comparison: Comparison) -> list[_Line]:
    """Return the lines, the least error first."""
    overall = comparison.overall
    policies = [
        _Line(
            name=ranked.name,
            rank=str(ranked.rank) if overall.decisive else "",
            error=ranked.rmse_mm,
            marker=CIRCLE,
            colour=ROBOT if overall.best(ranked) else INK,
            filled=overall.best(ranked),
        )
        for ranked in overall.policies
    ]
    others = [
        _Line(
            name=name,
            rank="",
            error=error,
            marker=DIAMOND if name == HUMAN_HUMAN_LABEL else SQUARE,
            colour=HUMAN if name == HUMAN_HUMAN_LABEL else FAINT,
            filled=name == HUMAN_HUMAN_LABEL,
        )
        for name, error in overall.unranked_rmse_mm.items()
    ]
    return sorted([*policies, *others], key=lambda each: each.error.mean)
