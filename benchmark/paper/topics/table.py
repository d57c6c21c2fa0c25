"""Table I: claims, and the table as a picture (section IV.E)."""

from typing import Final

from colift.benchmark.paper.exhibits import Claim, Exhibit, p_value_text
from colift.benchmark.paper.table_one import SubjectRow, TableOne
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.panels import legend, panels
from colift.benchmark.rendering.style import DASHES, HUMAN, INK, ROBOT

CELL: Final = 0.12
"""Largest relative deviation of a cell of Table I."""

COLUMN: Final = 0.05
"""Largest relative deviation of a column's mean."""

RATIO: Final = 0.04
"""Largest deviation of the ratio of the means."""

SURE: Final = 0.01
"""Largest p value of a subject's difference."""

FEWEST: Final = 8
"""Least number of lifts whose sign flips can give such a p value: the least is 2 / 2^lifts."""

BASELINE: Final = 0.7
"""Largest deviation of the human-human baseline [mm]."""

BESIDE: Final = 0.13
"""Distance of a point from the middle of its subject, where the distance of subjects is 1."""


def table_claims(table: TableOne) -> list[Claim]:
    """Return the claims about Table I."""
    return [
        _lower(table),
        _reproduced(table),
        _ratio(table),
        _practised(table),
        _human_human(table),
    ]


def _lower(table: TableOne) -> Claim:
    worst = max(table.rows, key=lambda row: row.p)
    least = max(table.rows, key=lambda row: row.difference.mean)
    few = f"; fewer than {FEWEST} can give no p below {SURE}" if table.lifts < FEWEST else ""
    return Claim(
        claim="For all users, the RMSE is lower with prediction than without.",
        figure="Table I",
        paper="lower by 4.7 to 7.0 mm in each of 5 subjects",
        criterion=f"the mean difference is negative for every subject, paired p < {SURE} each",
        measured=f"mean difference {table.mean.difference.mean:.2f} mm; smallest for "
        f"{least.subject}: {least.difference.mean:.2f} mm; largest p: {p_value_text(worst.p)}",
        values={f"difference_{row.subject}_mm": row.difference.mean for row in table.rows}
        | {f"p_{row.subject}": row.p for row in table.rows},
        holds=all(row.difference.mean < 0 and row.p < SURE for row in table.rows),
        note="Sign flips over the lifts of each subject."
        if worst.p < SURE
        else f"{worst.subject}: {p_value_text(worst.p)} with {table.lifts} lifts{few}.",
    )


def _reproduced(table: TableOne) -> Claim:
    cells = {
        f"{row.subject} {name}": cell.ratio
        for row in table.rows
        for name, cell in (("without", row.reactive), ("with", row.blend))
    }
    columns = {"without": table.mean.reactive.ratio, "with": table.mean.blend.ratio}
    off = {name: ratio for name, ratio in cells.items() if abs(ratio - 1) > CELL}
    off |= {f"mean {n}": ratio for n, ratio in columns.items() if abs(ratio - 1) > COLUMN}
    worst = max(cells, key=lambda name: abs(cells[name] - 1))
    outside = ", ".join(f"{name} {ratio:.3f}" for name, ratio in off.items())
    return Claim(
        claim="The errors of Table I.",
        figure="Table I",
        paper=f"means {table.mean.reactive.paper:.2f} and {table.mean.blend.paper:.2f} mm",
        criterion="ours / the paper's: each cell within 12 %, both column means within 5 %",
        measured=f"means {table.mean.reactive.mean:.2f} and {table.mean.blend.mean:.2f} mm "
        f"(ratios {columns['without']:.3f} and {columns['with']:.3f}); cell furthest off: "
        f"{worst}, ratio {cells[worst]:.3f}",
        values={f"ratio {name}".replace(" ", "_"): ratio for name, ratio in cells.items()}
        | {f"ratio_mean_{name}": ratio for name, ratio in columns.items()},
        holds=not off,
        fitted=True,
        note=f"Outside: {outside}."
        if off
        else "The simulated subjects are calibrated to this table, on other seeds.",
    )


def _ratio(table: TableOne) -> Claim:
    ratio = table.ratio
    return Claim(
        claim="Prediction removes about a quarter of the error.",
        figure="Table I",
        paper=f"ratio of the means {ratio.paper:.3f}",
        criterion=f"our ratio within {ratio.paper:.3f} ± {RATIO}",
        measured=f"{ratio.mean:.3f} (95 % interval {ratio.ci95[0]:.3f} to {ratio.ci95[1]:.3f})",
        values={"ratio": ratio.mean},
        holds=abs(ratio.mean - ratio.paper) <= RATIO,
        fitted=True,
    )


def _practised(table: TableOne) -> Claim:
    def error(row: SubjectRow) -> float:
        return row.blend.mean

    best = min(table.rows, key=error)
    return Claim(
        claim="Subject 1, who had worked with the system for longer, does best.",
        figure="Table I",
        paper="12.967 mm, the lowest of the five with prediction",
        criterion="S1 has the lowest mean error with prediction",
        measured=f"{best.subject} has the lowest: {best.blend.mean:.2f} mm",
        values={f"{row.subject}_mm": row.blend.mean for row in table.rows},
        holds=best.subject == "S1",
        fitted=True,
        note="The simulated S1 has the lowest lift, fitted to the paper's subject 1, and no more "
        "practice than the others.",
    )


def _human_human(table: TableOne) -> Claim:
    human_human, blend, reactive = table.human_human, table.mean.blend, table.mean.reactive
    low, high = human_human.ci95
    better = high < blend.ci95[0] and blend.ci95[1] < reactive.ci95[0]
    near = abs(human_human.mean - human_human.paper) <= BASELINE
    return Claim(
        claim="Two people do better than a human with the robot, with prediction or without.",
        figure="figure 9, Table I",
        paper=f"{human_human.paper:.3f} mm (one pair of people, no standard deviation given)",
        criterion=f"baseline below blend below reactive with intervals apart, and "
        f"{human_human.paper:.1f} ± {BASELINE} mm",
        measured=f"{human_human.mean:.2f} mm (95 % interval {low:.2f} to {high:.2f}), "
        f"against {blend.mean:.2f} with and {reactive.mean:.2f} mm without prediction",
        values={
            "human_human_mm": human_human.mean,
            "blend_mm": blend.mean,
            "reactive_mm": reactive.mean,
        },
        holds=better and near,
        fitted=True,
        note="The partner's level is calibrated to this number by one parameter; the order is not."
        if better and near
        else f"Order {'holds' if better else 'does not hold'}; level "
        f"{'holds' if near else 'does not'}.",
    )


def table_exhibit(table: TableOne, layout: Layout) -> Exhibit:
    """Return the errors of Table I as points, ours with their 95 % intervals."""
    rows = table.rows
    figure, ((axes,),) = panels(layout, ["RMSE [mm]"], [3.0], x_label="subject")
    for index, row in enumerate(rows):
        for cell, colour, marker, name, shift in (
            (row.reactive, ROBOT, "o", "without prediction", -BESIDE),
            (row.blend, HUMAN, "D", "with prediction", BESIDE),
        ):
            low, high = cell.ci95
            first = index == 0
            axes.plot([index + shift] * 2, [low, high], color=colour, lw=2.2)
            axes.plot(
                index + shift, cell.mean, marker, color=colour, ms=6, label=name if first else None
            )
            axes.hlines(
                cell.paper,
                index + shift - BESIDE,
                index + shift + BESIDE,
                color=INK,
                lw=1.6,
                label="the paper" if first and shift > 0 else "_",
            )
    level = table.human_human.mean
    axes.axhline(level, color="#009E73", lw=1.4, ls=DASHES, label="two people")
    axes.set_xticks(range(len(rows)), [row.subject for row in rows])
    axes.set_ylim(bottom=0)
    legend(axes)
    return Exhibit(
        name="table-1",
        title="Table I as a picture",
        caption="Mean error of each subject without and with prediction, with 95 % intervals; the "
        "dashes are the paper's means, the broken line is two people, here.",
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
