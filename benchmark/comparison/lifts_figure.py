"""The errors from lift to lift of a session, as a figure."""

from typing import Final

from colift.benchmark.comparison.compare import Comparison
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.panels import draw_estimates, legend, panels
from colift.benchmark.rendering.style import DASHES, HUMAN, PEOPLE, SKY
from colift.benchmark.results.curve import lift_errors
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

MOST: Final = 6
"""Number of policies, from the best, that are drawn."""


def lifts_figure(comparison: Comparison, layout: Layout) -> Figure:
    """Return the figure: a line for each policy, with 95 % intervals; the lifts that count shaded.

    Parameters
    ----------
    comparison
        A comparison on a suite of sessions.
    layout
        Size of the figure.
    """
    results, suite = comparison.results, comparison.results.suite
    figure, ((axes,),) = panels(layout, [results.axes[0].axis], [2.8], x_label="lift")
    first = 1 + [*map(suite.counts, range(suite.session))].index(True)
    axes.axvspan(first - 0.5, suite.session + 0.5, color=SKY, lw=0)
    scores = {each.name: each.scores for each in results.policies}
    best = [each.name for each in comparison.overall.policies][:MOST]
    draw_estimates(axes, {name: [*enumerate(lift_errors(suite, scores[name]), 1)] for name in best})
    people = [each.mean for each in lift_errors(suite, results.human_human)]
    axes.plot(range(1, len(people) + 1), people, color=HUMAN, lw=1.4, ls=DASHES, label=PEOPLE)
    axes.set_xlim(0.5, suite.session + 0.5)
    axes.set_ylim(bottom=0)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    legend(axes)
    return figure
