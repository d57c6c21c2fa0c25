"""A figure as files: text, fonts, colours, and the same bytes in every run."""

import os
import subprocess
import sys
from pathlib import Path

import matplotlib as mpl
import pytest
from colift.base.errors import InputError
from colift.benchmark.rendering.figures import drawn_for, figure_bytes, write_all
from colift.benchmark.rendering.layout import LAYOUTS, PAGE, SLIDE, SUFFIXES, Layout, find_layout
from colift.benchmark.rendering.style import HUMAN, style_axes
from matplotlib.figure import Figure

from tests.printed import check_figure, check_size

TEXT = "error \N{MINUS SIGN}1 \N{RIGHTWARDS ARROW} 2\N{MULTIPLICATION SIGN} φ"


def made(layout: Layout) -> Figure:
    with drawn_for(layout):
        figure = Figure(figsize=layout.size(2.0), layout="constrained")
        axes = figure.add_subplot()
        style_axes(axes)
        axes.plot([-1.0, 2.0, 0.5], color=HUMAN, label="two people")
        axes.legend()
        axes.set_xlabel(TEXT)
    return figure


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_its_text_is_text_in_the_size_of_the_layout(layout: Layout, tmp_path: Path) -> None:
    write_all(tmp_path, "some", made(layout), "A figure")
    words = check_figure(tmp_path / "some", layout)
    assert {*TEXT.split(), "two", "people", "\N{MINUS SIGN}1"} <= words
    check_size(tmp_path / "some", layout)


def test_a_slide_has_the_shape_of_one() -> None:
    width, height = SLIDE.size(99.0)
    assert width / height == pytest.approx(16 / 9)


def test_a_users_settings_change_no_file() -> None:
    plain = {suffix: figure_bytes(made(PAGE), suffix, "t") for suffix in SUFFIXES}
    others = {
        "font.size": 20.0,
        "savefig.bbox": "tight",
        "svg.fonttype": "path",
        "lines.linewidth": 9,
    }
    with mpl.rc_context(others):
        assert {suffix: figure_bytes(made(PAGE), suffix, "t") for suffix in SUFFIXES} == plain
    assert mpl.rcParams["font.size"] == 10.0


PROGRAM = """
import sys
from hashlib import sha256
from tests.benchmark.rendering.test_figures import PAGE, SUFFIXES, figure_bytes, made
print(*(sha256(figure_bytes(made(PAGE), each, "t")).hexdigest() for each in SUFFIXES))
"""


@pytest.mark.slow
def test_its_bytes_depend_neither_on_the_day_nor_on_the_process() -> None:
    environments = (
        {"PYTHONHASHSEED": "1"},
        {"PYTHONHASHSEED": "2", "SOURCE_DATE_EPOCH": "0", "TZ": "Asia/Tokyo", "LC_ALL": "C"},
    )
    printed = {
        subprocess.run(
            [sys.executable, "-c", PROGRAM],
            env={**os.environ, **each},
            capture_output=True,
            check=True,
        ).stdout
        for each in environments
    }
    assert len(printed) == 1


def test_a_layout_that_is_none_is_refused_with_all_names() -> None:
    with pytest.raises(InputError, match=r"'colum'; did you mean column.*column, page, slide"):
        find_layout("colum")
