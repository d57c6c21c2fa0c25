"""The report: tables, figures and claims from the evidence, and its files."""

import csv
import dataclasses
import json
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any, Final

import numpy as np
from colift.agents.control.predictor import PredictorParameters
from colift.benchmark.episode.loop import Episode
from colift.benchmark.paper.evidence import Evidence
from colift.benchmark.paper.exhibits import Claim, Exhibit
from colift.benchmark.paper.pages import report_pages
from colift.benchmark.paper.table_one import TableOne, table_one
from colift.benchmark.paper.topics.confidence import (
    confidence_claims,
    confidence_exhibit,
    pause_exhibit,
)
from colift.benchmark.paper.topics.forgetting import forgetting_claims, forgetting_exhibit
from colift.benchmark.paper.topics.learning import learning_claims, learning_exhibit
from colift.benchmark.paper.topics.performance import (
    comparison_exhibit,
    error_limit,
    human_human_exhibit,
    performance_claims,
)
from colift.benchmark.paper.topics.practice import practice_claims
from colift.benchmark.paper.topics.prediction import prediction_claims, prediction_exhibit
from colift.benchmark.paper.topics.table import table_claims, table_exhibit
from colift.benchmark.paper.topics.timing import timing_claims, timing_exhibit, timing_results
from colift.benchmark.paper.topics.torque import torque_claims
from colift.benchmark.paper.watched import SampledLift
from colift.benchmark.rendering.figures import drawn_for, write_all
from colift.benchmark.rendering.layout import PAGE, Layout

PAGES: Final = ("report.html", "report.md", "claims.json")
"""The files of a report beside the figures, each a PNG, an SVG, a PDF and a CSV."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Report:
    """Everything that the pages show."""

    table: TableOne
    fresh: TableOne
    """Table I at latency 0."""
    exhibits: list[Exhibit]
    claims: list[Claim]
    provenance: str
    """Origin of the report, in one line."""


def make_report(evidence: Evidence, layout: Layout = PAGE) -> Report:
    """Return the report of the evidence, its figures in a layout."""
    table = table_one(evidence.reactive, evidence.blend, evidence.human_human)
    suite = evidence.blend.suite
    with drawn_for(layout):
        exhibits = all_exhibits(evidence, table, layout)
    changed = evidence.parameters != PredictorParameters()
    return Report(
        table=table,
        fresh=table_one(evidence.fresh.reactive, evidence.fresh.blend, evidence.human_human),
        exhibits=exhibits,
        claims=all_claims(evidence, table),
        provenance=f"colift {version('colift')}, suite {suite.name}, digest {suite.digest}, "
        f"seeds {suite.seeds[0]} to {suite.seeds[-1]}, {table.lifts} lifts per subject and case"
        + (f", with {evidence.blend.policy}" if changed else ""),
    )


def claims_json(report: Report) -> list[dict[str, Any]]:
    """Return the claims, in the form of ``claims.json``."""
    return [dataclasses.asdict(claim) for claim in report.claims]


def write_report(report: Report, folder: Path) -> None:
    """Write the report into a folder: pages, claims, and files and a CSV for each figure."""
    folder.mkdir(parents=True, exist_ok=True)
    for exhibit in report.exhibits:
        write_all(folder, exhibit.name, exhibit.figure, exhibit.title)
        _write_csv(folder / f"{exhibit.name}.csv", exhibit)
    pages = (
        *report_pages(
            report.table,
            report.fresh,
            report.exhibits,
            {each.name: (folder / f"{each.name}.png").read_bytes() for each in report.exhibits},
            report.claims,
            report.provenance,
        ),
        json.dumps(claims_json(report), indent=2, allow_nan=False, ensure_ascii=False) + "\n",
    )
    for name, content in zip(PAGES, pages, strict=True):
        (folder / name).write_text(content, encoding="utf-8")


def _write_csv(path: Path, exhibit: Exhibit) -> None:
    """Write the columns; the cells of missing values, and those below a short column, are empty."""
    columns = exhibit.columns
    length = max(len(values) for values in columns.values())
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for row in range(length):
            writer.writerow(
                _cell(values[row]) if row < len(values) else "" for values in columns.values()
            )


def _cell(value: float | str) -> float | str:
    return "" if value != value else value


def all_exhibits(evidence: Evidence, table: TableOne, layout: Layout) -> list[Exhibit]:
    """Return all figures in the report's order.

    Where a figure shows one lift, it is the one with the median error of its experiment: neither
    the best nor the worst. Figures 4, 5, 8 and 9 show the same lift.
    """
    shown = median_lift([lift.episode for lift in evidence.lifts])
    lift, reactive = evidence.lifts[shown], evidence.reactive.episodes[shown]
    limit = error_limit(lift.episode, reactive)
    return [
        table_exhibit(table, layout),
        prediction_exhibit(lift, layout),
        confidence_exhibit(lift, layout),
        pause_exhibit(_median(evidence.pauses), layout),
        forgetting_exhibit(_median(evidence.rests), layout),
        comparison_exhibit(lift.episode, reactive, layout),
        human_human_exhibit(evidence.human_human.episodes[shown], limit, layout),
        learning_exhibit(evidence.learning, layout),
        timing_exhibit(timing_results(evidence), layout),
    ]


def median_lift(episodes: Sequence[Episode]) -> int:
    """Return the index of the episode with the (lower) median error."""
    order = np.argsort([episode.scores["rmse_mm"] for episode in episodes], kind="stable")
    return int(order[(len(order) - 1) // 2])


def _median(lifts: Sequence[SampledLift]) -> SampledLift:
    return lifts[median_lift([lift.episode for lift in lifts])]


__all__ = ["Claim", "all_claims"]


def all_claims(evidence: Evidence, table: TableOne) -> list[Claim]:
    """Return every claim of the paper, measured, in the order of the paper's section IV."""
    return [
        *learning_claims(evidence.learning),
        *prediction_claims(evidence.lifts),
        *confidence_claims(evidence.lifts, evidence.pauses),
        *forgetting_claims(evidence.rests, evidence.pauses, evidence.forgetting),
        *table_claims(table),
        *practice_claims(evidence.practice["reactive"], evidence.practice["blend"], table),
        *performance_claims(evidence),
        *torque_claims(evidence),
        *timing_claims(evidence),
    ]
