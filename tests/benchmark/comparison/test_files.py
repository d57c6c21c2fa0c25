"""JSON, table, picture and page of a comparison."""

import csv
import dataclasses
import io
import json
import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from colift.benchmark.comparison.captions import failures, verdict
from colift.benchmark.comparison.compare import Comparison, compare
from colift.benchmark.comparison.files import (
    comparison_csv,
    comparison_json,
    write_comparison,
)
from colift.benchmark.rendering.layout import LAYOUTS, Layout
from PIL import Image

from tests.printed import check_figure


@pytest.fixture(scope="module")
def folder(comparison: Comparison, tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("out") / "new"
    write_comparison(made, comparison)
    return made


def test_the_files_are_those_named(folder: Path) -> None:
    figures = {f"{name}.{kind}" for name in ("compare", "ranks") for kind in ("png", "svg", "pdf")}
    texts = {f"compare.{kind}" for kind in ("csv", "html", "json", "tex", "bib")}
    assert {path.name for path in folder.iterdir()} == figures | texts


def test_equal_comparisons_give_equal_files(
    folder: Path, comparison: Comparison, tmp_path: Path
) -> None:
    write_comparison(tmp_path, comparison)
    for path in folder.iterdir():
        assert (tmp_path / path.name).read_bytes() == path.read_bytes()


def test_json_has_every_policy_in_every_part(folder: Path, comparison: Comparison) -> None:
    content = json.loads((folder / "compare.json").read_text())
    assert content == json.loads(json.dumps(comparison_json(comparison)))
    names = {policy["name"] for policy in content["policies"]}
    for part in (*content["behaviours"], *content["subjects"]):
        assert {policy["name"] for policy in part["policies"]} == names
    fronts = {policy["name"]: policy["pareto_front"] for policy in content["policies"]}
    assert [name for name, on in fronts.items() if on] == ["leader", "follower"]
    assert content["policies"][-1]["sparc"] == {"mean": None, "ci95": None, "missing": 64}


def test_csv_has_a_row_for_each_policy_and_part_and_no_value_where_there_is_none(
    comparison: Comparison,
) -> None:
    rows = list(csv.DictReader(io.StringIO(comparison_csv(comparison))))
    assert len(rows) == 5 * (1 + 4 + 8)
    first = rows[0]
    assert (first["scope"], first["policy"], first["to_best_p"]) == ("all", "leader", "")
    assert rows[4]["policy"] == "still"
    assert rows[4]["sparc"] == rows[4]["sparc_low"] == ""
    assert float(rows[1]["to_best_mm_low"]) < float(rows[1]["to_best_mm"])


class Page(HTMLParser):
    """Collects the text of a page, what it points at and what it leaves open."""

    def __init__(self) -> None:
        super().__init__()
        self.text = ""
        self.targets: list[str] = []
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in ("meta", "wbr"):
            self.open.append(tag)
        self.targets += [
            value or "" for name, value in attrs if name in ("src", "href", "xlink:href")
        ]

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        self.handle_endtag(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if "style" not in self.open:
            self.text += data


def test_the_page_is_whole_and_needs_nothing_else(folder: Path, comparison: Comparison) -> None:
    source = (folder / "compare.html").read_text()
    page = Page()
    page.feed(source)
    assert page.open == []
    assert all(target.startswith("#") for target in page.targets)
    assert "url(http" not in source
    assert "<script" not in source
    for told in ("leader", "two people", "By behaviour", "By subject", "jerky", "P2"):
        assert told in page.text
    assert verdict(comparison) in page.text
    assert failures(comparison)[0] in page.text


def test_the_page_has_colours_for_the_dark(folder: Path) -> None:
    source = (folder / "compare.html").read_text()
    named = set(re.findall(r"var\((--\w+)\)", source))
    light, dark = source.split("prefers-color-scheme: dark", 1)
    for name in named:
        assert f"{name}:" in light
        assert f"{name}:" in dark
    drawn = source[source.index("<svg") : source.rindex("</svg>")]
    assert not re.findall(r"""(?:fill|stroke)(?:: |=")#\w+""", drawn)


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_the_figures_are_for_print(comparison: Comparison, layout: Layout, tmp_path: Path) -> None:
    write_comparison(tmp_path, comparison, layout)
    names = {"leader", "follower", "twin", "two", "people"}
    assert names <= check_figure(tmp_path / "compare", layout)
    assert names | {"1", "3"} <= check_figure(tmp_path / "ranks", layout)


def test_the_picture_fits_a_readme(folder: Path) -> None:
    with Image.open(folder / "compare.png") as image:
        assert image.width >= 1000
        assert image.height < image.width


def test_the_words_say_who_wins_and_who_failed(comparison: Comparison) -> None:
    assert verdict(comparison) == (
        "leader is the most level: 11.5 mm, 1.27 times the error of two people on the "
        "same lift (mean 9.5 mm). "
        "twin cannot be distinguished from it."
    )
    assert failures(comparison) == [
        "failing: 3 of 64 lifts failed and count as worst; first reason: step 3: oops"
    ]


def test_the_words_say_where_it_is_better_than_people(comparison: Comparison) -> None:
    follower = [e for e in comparison.results.policies if e.name in ("follower", "still")]
    two = compare(dataclasses.replace(comparison.results, policies=tuple(follower)))
    assert verdict(two).endswith(" On jerky it is more level than two people.")
