"""The table of LaTeX, and what to cite."""

import dataclasses
import shutil
import subprocess
from pathlib import Path

import pytest
from colift.benchmark.comparison.compare import Comparison, compare
from colift.benchmark.comparison.tex import comparison_tex
from colift.benchmark.rendering.layout import COLUMN, PAGE, Layout
from colift.benchmark.results.citation import bibtex

from tests.benchmark.comparison.conftest import DIFFICULTY, noise, paired, policy_results

ODD = r"a_b,c=5%&{x}^~\#$"
"""A name with every character that TeX would take for a command."""


@pytest.fixture(scope="module")
def odd() -> Comparison:
    error = DIFFICULTY + 5.0 + noise(9)
    return compare(paired(policy_results(ODD, error, -2.0), policy_results("b", error + 3.0, -2.1)))


def rows(text: str) -> list[list[str]]:
    """Return the cells of the lines of a table, its heads left out."""
    return [
        line.removesuffix(r" \\").split(" & ")
        for line in text.splitlines()
        if line.endswith(r"\\") and "multicolumn" not in line
    ]


def test_a_line_has_rank_error_and_ratio_with_their_intervals(comparison: Comparison) -> None:
    first, *_ = rows(comparison_tex(comparison, COLUMN))
    leader = comparison.overall.policies[0]
    low, high = leader.rmse_mm.ends
    assert first[:4] == [
        "1",
        "leader",
        rf"\textbf{{{leader.rmse_mm.mean:.2f}}}",
        f"[{low:.2f}, {high:.2f}]",
    ]
    assert first[4] == f"{leader.vs_human.mean:.2f}"


def test_all_lines_are_as_long_as_the_heads(comparison: Comparison) -> None:
    for layout, count, kind in ((COLUMN, 6, "table}"), (PAGE, 8, "table*}")):
        text = comparison_tex(comparison, layout)
        assert {len(cells) for cells in rows(text)} == {count}
        assert rf"\begin{{{kind}" in text
        assert len(rows(text)) == len(comparison.overall.policies) + 1  # And two people.


def test_marks_are_explained_where_they_stand(comparison: Comparison) -> None:
    page, column = (comparison_tex(comparison, each) for each in (PAGE, COLUMN))
    assert page.count(r"\dagger$") == 2  # The policy that fails, and the caption.
    assert r"\dagger$" not in column
    still = next(cells for cells in rows(page) if cells[1].startswith("still"))
    assert still[6] == "--"


def test_people_too_few_for_ranks_are_told(comparison: Comparison) -> None:
    few = dataclasses.replace(
        comparison, overall=dataclasses.replace(comparison.overall, decisive=False, people=1)
    )
    text = comparison_tex(few, COLUMN)
    assert "No ranks: a single person is too few" in text
    assert {cells[0] for cells in rows(text)} == {""}


@pytest.mark.skipif(not shutil.which("pdflatex"), reason="there is no LaTeX")
@pytest.mark.parametrize("layout", [COLUMN, PAGE], ids=["column", "page"])
def test_latex_sets_it_without_a_warning(odd: Comparison, layout: Layout, tmp_path: Path) -> None:
    (tmp_path / "compare.tex").write_text(comparison_tex(odd, layout))
    (tmp_path / "compare.bib").write_text(bibtex(odd.results.suite))
    (tmp_path / "main.tex").write_text(
        r"\documentclass[twocolumn]{article}\usepackage{booktabs}\usepackage[textwidth=7.1in]{geometry}\begin{document}"
        r"\input{compare.tex}Table~\ref{tab:quick-v1} \cite{colift,thobbi2011using}"
        r"\bibliographystyle{plain}\bibliography{compare}\end{document}"
    )
    for command in ("pdflatex", "bibtex", "pdflatex", "pdflatex"):
        stops = [] if command == "bibtex" else ["-halt-on-error", "-interaction=nonstopmode"]
        done = subprocess.run(
            [command, *stops, "main"], cwd=tmp_path, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stdout[-2000:]
    assert "Warning" not in done.stdout
    assert "Overfull" not in done.stdout


def test_what_to_cite_names_version_and_suite(odd: Comparison) -> None:
    suite = odd.results.suite
    assert f"suite quick-v1 with digest {suite.digest}" in bibtex(suite)
    assert bibtex(suite).count("@") == 2
