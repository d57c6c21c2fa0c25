"""Comparisons and pictures of lifts by the front door, as a notebook shows them."""

import subprocess
import sys
import xml.etree.ElementTree as ET

import colift
import pytest
from colift.agents.policies.blend import Blend
from colift.base.errors import InputError

from tests.printed import assert_neutral


@pytest.fixture(scope="module")
def copied():
    return colift.evaluate("copy")


def view(page):
    """Return the elements of a view."""
    return ET.fromstring(f"<div>{page.replace('<br>', '<br/>')}</div>")


def test_a_comparison_of_an_evaluation_a_name_and_an_object(copied, tmp_path):
    found = colift.compare(copied, "hold", Blend())
    assert [each.name for each in found.policies] == ["Blend", "copy", "hold"]
    assert found.policies[1].rmse_mm.mean == pytest.approx(copied.rmse_mm)
    assert str(found).startswith("3 policies on quick-v1")
    assert repr(found).startswith("<Comparison of 3 policies: Blend is the most level")
    page = found._repr_html_()
    root = view(page)
    assert len([*root.iter("table")]) == 3
    assert "two people" in " ".join(root.itertext())
    assert_neutral(page)
    found.save(tmp_path / "made", layout="column")
    rows = (tmp_path / "made" / "compare.csv").read_text().splitlines()
    assert len(rows) == 1 + len(found.rows())
    assert r"\begin{table}" in (tmp_path / "made" / "compare.tex").read_text()
    assert "suite quick-v1" in found.bibtex


def test_policies_of_one_name_are_told_apart_by_their_place(copied):
    found = colift.compare(copied, copied)
    assert [each.name for each in found.policies] == ["copy (1)", "copy (2)"]


@pytest.mark.parametrize(
    ("policies", "told"),
    [
        (("copy",), "at least two policies to compare, got 1"),
        (("copy", "copy"), "copy is named twice"),
        (("copy", "nobody"), "unknown policy 'nobody'"),
        (("copy", "pose_wrist"), "pose_wrist"),
    ],
)
def test_what_cannot_be_compared_is_refused_in_words(policies, told):
    with pytest.raises(InputError, match=told):
        colift.compare(*policies)


def test_lifts_that_differ_are_not_compared(copied):
    with pytest.raises(InputError, match="the evaluation of copy has the lifts of quick-v1"):
        colift.compare(copied, "hold", suite="standard-v1")
    with pytest.raises(InputError, match="was played over no channel, not over the channel home"):
        colift.compare(copied, "hold", channel="home")


@pytest.fixture(scope="module")
def rendered():
    return colift.render("copy", behaviour="pause", seed=2)


def test_a_lift_is_three_pictures_and_a_chart_light_or_dark(rendered):
    page = rendered._repr_html_()
    root = view(page)
    assert len([*root.iter("{http://www.w3.org/2000/svg}image")]) == 3
    assert {"height", "[mm]", "difference"} <= set(" ".join(root.itertext()).split())
    assert_neutral(page)


def test_it_says_what_it_is(rendered):
    assert repr(rendered) == f"<Lift of copy, pause, S1, seed 2: RMSE {_rmse(rendered):.1f} mm>"
    assert rendered.episode.behaviour == "pause"


def _rmse(rendered):
    return rendered.episode.scores["rmse_mm"]


def test_it_is_the_lift_of_the_command(rendered, tmp_path):
    options = ("--behaviour", "pause", "--seed", "2", "--out", "lift.svg", "--for", "column")
    command = (sys.executable, "-m", "colift", "render", "copy", *options)
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert f"RMSE {_rmse(rendered):.1f} mm" in done.stdout
    rendered.save(tmp_path / "other.svg", "column")
    assert (tmp_path / "lift.svg").read_bytes() == (tmp_path / "other.svg").read_bytes()


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ({"behaviour": "smoth"}, "did you mean smooth"),
        ({"subject": "S9"}, "S9"),
        ({"seed": -1}, "seed must not be negative, got -1"),
        ({"policy": "pose_wrist"}, "pose_wrist"),
        ({"camera": "below"}, "below"),
        ({"policy": "nobody"}, "unknown policy 'nobody'"),
    ],
)
def test_what_cannot_be_drawn_is_refused_in_words(arguments, told):
    with pytest.raises(InputError, match=told):
        colift.render(**{"policy": "copy", **arguments})


def test_a_file_of_another_kind_or_size_is_refused(rendered, tmp_path):
    with pytest.raises(InputError, match=r"\.svg"):
        rendered.save(tmp_path / "lift.bmp")
    with pytest.raises(InputError, match="did you mean column"):
        rendered.save(tmp_path / "lift.svg", "colum")


class Failing:
    def reset(self, seed):
        pass

    def act(self, observation):
        raise ValueError("no idea")


def test_a_policy_that_fails_says_why():
    with pytest.raises(InputError, match="the policy failed: step 0: ValueError: no idea"):
        colift.render(Failing())
