"""The look that axes share: a light grid, no box."""

from matplotlib.axes import Axes

from .palette import FAINT, LINE


def plain(axes: Axes) -> None:
    """Give axes the common look."""
    axes.grid(color=LINE, linewidth=0.7)
    axes.set_axisbelow(True)
    axes.tick_params(labelsize=8.5, colors=FAINT, length=0)
    for side in ("top", "left", "right"):
        axes.spines[side].set_visible(False)
    axes.spines["bottom"].set_color(LINE)
