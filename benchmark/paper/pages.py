"""The report's pages, one HTML file and Markdown with figures beside it, and their text."""

from base64 import b64encode
from collections.abc import Mapping, Sequence
from typing import Final

from colift.benchmark.paper.exhibits import Claim, Exhibit
from colift.benchmark.paper.table_one import Reproduction, SubjectRow, TableOne
from colift.benchmark.rendering.page import Cell, Row, render

TITLE: Final = "Using Human Motion Estimation for Human-Robot Cooperative Manipulation, reproduced"

INTRODUCTION: Final = (
    "The results of section IV of Thobbi, Gu and Sheng (IROS 2011), measured again in simulation "
    "with their framework: a reactive controller learned by Q-learning, a Kalman filter that "
    "predicts the human one step ahead, and a confidence that mixes the two. "
    "Every number of ours comes from the run that made this page. "
    "Subjects are simulated people, calibrated to Table I."
)

TABLE_CAPTION: Final = (
    "RMSE of the height difference of the table's ends [mm], mean over the lifts, with 95 % "
    "bootstrap intervals over the seeds. The paper's cells are means of 10 lifts. Ratio: ours / "
    "the paper's. Difference: with minus without prediction on the same lifts; p by paired sign "
    "flips."
)

HEADER: Final = (
    "Subject",
    "Without: paper",
    "ours",
    "ratio",
    "With: paper",
    "ours",
    "ratio",
    "Difference",
    "p",
)

LATENCY_HEADER: Final = ("RMSE [mm]", "Paper", "Ours, samples 100 ms old", "Ours, fresh samples")

LATENCY_CAPTION: Final = (
    "The paper states the control period and takes each sample when an action is complete, which "
    "reads as a fresh one. The latency of 0.1 s is a choice of colift, and the lift heights were "
    "fitted at it: Table I fixes height, duration and latency only jointly. Here the heights are "
    "the same in both columns."
)

DEFINITIONS: Final = (
    "A step is one control period, 100 ms. A prediction is one step ahead of the sample it was "
    "made from, and is checked against the next sample; the sample itself is 100 ms old when the "
    "robot decides, by our choice.",
    "The motion begins with the first sample taken after the human's intention starts to move; "
    "a pause begins with the first sample taken after it starts to brake. Intentions are known "
    "to the simulation only, never to the robot.",
    "Fluctuation of the confidence C: root mean square of its change from one step to the next. "
    "Settling: steps from the human's standstill until C first comes within 5 % of its value at "
    "rest, which is its mean over the last quarter of the rest.",
    "SPARC is the spectral arc length of the speed of the robot's table end over each stroke; "
    "closer to 0 is smoother. Absolute error is eq. 10 of the paper, summed over frames of 10 ms.",
    "p values are two-sided, by random sign flips of the paired differences over lifts.",
    "Where one lift is drawn, it is the one with the median error.",
)


def report_pages(
    table: TableOne,
    fresh: TableOne,
    exhibits: Sequence[Exhibit],
    drawn: Mapping[str, bytes],
    claims: Sequence[Claim],
    provenance: str,
) -> tuple[str, str]:
    """Return the report as HTML and as Markdown.

    Parameters
    ----------
    table, fresh, exhibits, claims
        Table I at the suite's latency and at latency 0, figures and claims of the report.
    drawn
        Each picture as PNG, by name.
    provenance
        Origin of the report, in one line.
    """
    lines = table_rows(table)
    content = {
        "title": TITLE,
        "introduction": INTRODUCTION,
        "table_caption": TABLE_CAPTION,
        "header": HEADER,
        "definitions": DEFINITIONS,
        "provenance": provenance,
        "lines": lines,
        "rows": [_row(*line) for line in lines],
        "notes": table_notes(table),
        "latency_caption": LATENCY_CAPTION,
        "latency_header": LATENCY_HEADER,
        "latency_lines": latency_rows(table, fresh),
        "latency_rows": [_row(*line) for line in latency_rows(table, fresh)],
        "exhibits": exhibits,
        "drawn": {name: b64encode(png).decode("ascii") for name, png in drawn.items()},
        "claims": claims,
        "verdict": claims_verdict(claims),
    }
    html, markdown = (render(__package__, f"report.{kind}", **content) for kind in ("html", "md"))
    return html, markdown


def _row(name: str, *values: str) -> Row:
    """Return a row of the table; an interval in brackets goes under its value."""
    parts = (value.partition(" (") for value in values)
    return Row(name, [Cell(mean, bracket.strip() + rest) for mean, bracket, rest in parts])


def table_rows(table: TableOne) -> list[tuple[str, ...]]:
    """Return the rows of Table I as text: subjects, then all together."""
    return [_texts(row) for row in (*table.rows, table.mean)]


def table_notes(table: TableOne) -> list[str]:
    """Return the lines under Table I."""
    return [
        f"Ratio of the means, with / without: paper {table.ratio.paper:.3f}, ours "
        f"{_ours(table.ratio, '.3f')}.",
        f"Two people: paper {table.human_human.paper:.3f} mm (one pair of people), ours "
        f"{_ours(table.human_human)} mm.",
    ]


def latency_rows(table: TableOne, fresh: TableOne) -> list[tuple[str, ...]]:
    """Return the means of Table I at both latencies as text: reactive, blend and their ratio."""
    return [
        (name, format(stale.paper, digits), _ours(stale, digits), _ours(new, digits))
        for name, stale, new, digits in (
            ("reactive", table.mean.reactive, fresh.mean.reactive, ".2f"),
            ("blend", table.mean.blend, fresh.mean.blend, ".2f"),
            ("ratio, blend / reactive", table.ratio, fresh.ratio, ".3f"),
        )
    ]


def _texts(row: SubjectRow) -> tuple[str, ...]:
    low, high = row.difference.ends
    return (
        row.subject,
        *_cells(row.reactive),
        *_cells(row.blend),
        f"{row.difference.mean:.2f} ({low:.2f} to {high:.2f})",
        f"{row.p:.4f}" if row.p >= 0.00015 else "< 0.0002",
    )


def _cells(cell: Reproduction) -> tuple[str, str, str]:
    return f"{cell.paper:.2f}", _ours(cell), f"{cell.ratio:.3f}"


def _ours(cell: Reproduction, digits: str = ".2f") -> str:
    low, high = (format(value, digits) for value in cell.ci95)
    return f"{cell.mean:{digits}} ({low} to {high})"


def claims_verdict(claims: Sequence[Claim]) -> str:
    """Return the numbers of independent and of fitted claims that hold, as a sentence."""
    return (
        f"{_count(claims)} claims hold: "
        f"{_count([each for each in claims if not each.fitted])} independent ones, and "
        f"{_count([each for each in claims if each.fitted])} to which the set-up was fitted."
    )


def _count(claims: Sequence[Claim]) -> str:
    return f"{sum(each.holds for each in claims)} of {len(claims)}"


def kind(claim: Claim) -> str:
    """Return whether a claim is independent or fitted, in a word."""
    return "fitted" if claim.fitted else "independent"
