"""Table I as a picture: the paper's means and ours, subject by subject."""

from ...rendering.palette import HUMAN, INK, ROBOT
from ..table_one import TableOne
from .picture import Picture, legend, panels


def table_picture(table: TableOne) -> Picture:
    """Return the errors of Table I as points, ours with their 95 % intervals."""
    rows = table.rows
    figure, ((axes,),) = panels(["RMSE [mm]"], [3.0], x_label="subject")
    for index, row in enumerate(rows):
        for cell, colour, name, shift in (
            (row.reactive, ROBOT, "without prediction", -0.12),
            (row.blend, HUMAN, "with prediction", 0.12),
        ):
            low, high = cell.ci95
            first = index == 0
            axes.plot([index + shift] * 2, [low, high], color=colour, lw=2.2)
            axes.plot(
                index + shift, cell.mean, "o", color=colour, ms=7, label=name if first else None
            )
            axes.plot(
                index + shift,
                cell.paper,
                "_",
                color=INK,
                ms=22,
                mew=1.6,
                label="the paper" if first and shift > 0 else None,
            )
    axes.axhline(table.team.mean, color="#009E73", lw=1.4, ls=(0, (4, 3)), label="two humans")
    axes.set_xticks(range(len(rows)), [row.subject for row in rows])
    axes.set_ylim(bottom=0)
    legend(axes)
    return Picture(
        name="table-1",
        title="Table I as a picture",
        caption="Mean error of each subject without and with prediction, with 95 % intervals; the "
        "dashes are the paper's means, the broken line is our team of two humans.",
        figure=figure,
        columns={
            "subject": [row.subject for row in rows],
            "paper_without_mm": [row.reactive.paper for row in rows],
            "without_mm": [row.reactive.mean for row in rows],
            "without_low_mm": [row.reactive.ci95[0] for row in rows],
            "without_high_mm": [row.reactive.ci95[1] for row in rows],
            "paper_with_mm": [row.blend.paper for row in rows],
            "with_mm": [row.blend.mean for row in rows],
            "with_low_mm": [row.blend.ci95[0] for row in rows],
            "with_high_mm": [row.blend.ci95[1] for row in rows],
            "difference_mm": [row.difference.mean for row in rows],
            "p": [row.p for row in rows],
        },
    )
