"""The files of the report: complete, self-contained, and saying the same."""

import csv
import json
import re

import numpy as np
import pytest
from colift.benchmark.paper.report import make_report, write_report
from colift.benchmark.paper.table_one import WITH_PREDICTION, WITHOUT_PREDICTION

FIGURES = (
    "table-1",
    *(f"figure-{number}" for number in (4, 5, 6, 7, 8, 9)),
    "q-learning",
    "timing",
)


FACTORS = ("0.05", "0.25", "0.45", "0.65", "0.85", "0.95")


def columns(path):
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: [row[name] for row in rows] for name in rows[0]}


def rmse(human, robot):
    z1, z2 = (np.array([float(value) for value in end if value]) for end in (human, robot))
    return 1000 * np.sqrt(np.mean((z1 - z2) ** 2))


def test_progress_adds_up_to_what_was_announced(made):
    assert made.counted == made.expected


def test_every_file_is_there(made):
    wanted = {f"{name}.{kind}" for name in FIGURES for kind in ("png", "svg", "pdf", "csv")}
    wanted |= {"report.html", "report.md", "claims.json"}
    assert {path.name for path in made.folder.iterdir()} == wanted


def test_the_page_needs_nothing_but_itself(made):
    page = (made.folder / "report.html").read_text()
    assert re.findall(r'(?:src|href)="(?!data:image/png;base64,)', page) == []
    assert not re.search(r"https?:|url\(|@import|<script|<link", page)
    assert page.count("data:image/png;base64,") == len(FIGURES)
    assert "prefers-color-scheme: dark" in page


def test_the_markdown_shows_every_figure_beside_it(made):
    shown = re.findall(r"\]\(([\w-]+\.png)\)", (made.folder / "report.md").read_text())
    assert shown == [f"{name}.png" for name in FIGURES]


def test_no_number_was_left_unformatted(made):
    for name in ("report.md", "claims.json"):
        assert not re.search(r"\{[a-z_]+[\[.:}]", (made.folder / name).read_text())


def test_claims_have_all_their_fields(made):
    claims = json.loads((made.folder / "claims.json").read_text())
    assert len(claims) > 20
    for claim in claims:
        assert list(claim) == [
            "claim",
            "figure",
            "paper",
            "criterion",
            "measured",
            "values",
            "holds",
            "fitted",
            "note",
        ]
        assert isinstance(claim["holds"], bool)
        assert claim["holds"] or claim["note"]
        assert all(value is None or np.isfinite(value) for value in claim["values"].values())
    assert len({claim["claim"] for claim in claims}) == len(claims)


def test_every_claim_is_on_both_pages(made):
    page, text = ((made.folder / f"report.{kind}").read_text() for kind in ("html", "md"))
    for claim in made.report.claims:
        assert claim.claim in text
    assert page.count('<li class="no">') == sum(not claim.holds for claim in made.report.claims)
    assert page.count('<li class="yes">') == sum(claim.holds for claim in made.report.claims)


def test_fitted_claims_are_counted_apart(made):
    page, text = ((made.folder / f"report.{kind}").read_text() for kind in ("html", "md"))
    claims = made.report.claims
    fitted = [claim for claim in claims if claim.fitted]
    assert {claim.figure for claim in fitted} == {"Table I", "figure 9, Table I"}
    own, other = len(fitted), len(claims) - len(fitted)
    counted = re.search(r"(\d+) of (\d+) independent ones, and (\d+) of (\d+) to which", page)
    held = sum(claim.holds for claim in fitted), sum(claim.holds for claim in claims)
    assert tuple(map(int, counted.groups())) == (held[1] - held[0], other, held[0], own)
    assert counted[0] in text
    assert text.count(", fitted\n") == page.count(", fitted</span>") == own


def test_both_latencies_stand_beside_the_paper(made):
    text = (made.folder / "report.md").read_text()
    runs = (made.evidence.blend, made.evidence.fresh.blend)
    means = [np.mean([e.scores["rmse_mm"] for e in run.episodes]) for run in runs]
    (line,) = (each for each in text.splitlines() if each.startswith("| blend |"))
    cells = [cell.split()[0] for cell in line.strip("| ").split(" | ")]
    assert cells[2:] == [f"{mean:.2f}" for mean in means]
    assert means[1] < 0.7 * means[0]


def test_the_table_is_the_mean_of_the_runs_beside_the_papers(made):
    table = columns(made.folder / "table-1.csv")
    assert table["subject"] == ["S1", "S3"]
    for run, ours, paper, published in (
        (made.evidence.reactive, "without_mm", "paper_without_mm", WITHOUT_PREDICTION),
        (made.evidence.blend, "with_mm", "paper_with_mm", WITH_PREDICTION),
    ):
        for subject, mean, printed in zip(table["subject"], table[ours], table[paper], strict=True):
            errors = [e.scores["rmse_mm"] for e in run.episodes if e.subject == subject]
            assert float(mean) == pytest.approx(np.mean(errors))
            assert float(printed) == published[subject]
            assert f"{np.mean(errors):.2f}" in (made.folder / "report.md").read_text()


def test_both_policies_meet_the_same_intentions(made):
    pairs = zip(made.evidence.reactive.episodes, made.evidence.blend.episodes, strict=True)
    for without, with_it in pairs:
        assert np.array_equal(without.trace.target, with_it.trace.target)


def test_figure_8_has_the_errors_that_the_runs_have(made):
    data = columns(made.folder / "figure-8.csv")
    for case, run in (("with", made.evidence.blend), ("without", made.evidence.reactive)):
        error = rmse(data[f"{case}_human_end_m"], data[f"{case}_robot_end_m"])
        assert error == pytest.approx(
            min((e.scores["rmse_mm"] for e in run.episodes), key=lambda other: abs(other - error))
        )


def test_figures_5_and_6_hold_confidences(made):
    for name in ("figure-5", "figure-6"):
        data = columns(made.folder / f"{name}.csv")
        confidence = np.array([float(value) for value in data["confidence"]])
        assert confidence.min() >= 0.0
        assert confidence.max() <= 1.0
        assert data["predicted_position_m"][0] == ""


def test_figure_7_has_all_six_factors(made):
    names = [name for name in columns(made.folder / "figure-7.csv") if "phi" in name]
    assert names == [f"confidence_phi_{phi}" for phi in FACTORS]


@pytest.mark.slow
def test_the_same_evidence_gives_the_same_files(made, tmp_path):
    write_report(make_report(made.evidence), tmp_path)
    for path in tmp_path.iterdir():
        assert path.read_bytes() == (made.folder / path.name).read_bytes()
