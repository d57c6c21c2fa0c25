"""Figures made for real, in a clone of the test's own."""

import pytest
from colift.base.errors import EvaluatorFault, InputError
from colift.benchmark.figures.making import command_output, remake, statuses
from colift.benchmark.figures.registry import FOLDER, REGISTRY, read_figures

FIGURES = """
[subjects]
command = "colift list | grep draw-N"
suites = ["quick-v1"]

[lift]
command = '''
mkdir pictures
colift render copy --out pictures/lift.png
'''
pictures = ["pictures/lift.png"]
suites = ["quick-v1"]
policies = ["copy"]

[recorded]
command = "wc -l < lifts.csv; ls examples; echo $COLUMNS $NO_COLOR; ls /proc/self/fd/0 >&2"
recordings = ["lifts.csv"]
suites = ["quick-v1"]

[failing]
command = "echo before; false; echo after"
machine = true

[without]
command = "echo nothing"
pictures = ["picture.png"]
machine = true
"""


@pytest.fixture
def root(tmp_path):
    """A folder with a registry and an example."""
    (tmp_path / FOLDER).mkdir(parents=True)
    (tmp_path / FOLDER / REGISTRY).write_text(FIGURES)
    (tmp_path / "examples").mkdir()
    (tmp_path / "examples" / "one.py").write_text("")
    return tmp_path


@pytest.fixture
def figures(root):
    return read_figures(root / FOLDER)


@pytest.mark.slow
def test_a_figure_is_due_until_it_is_made_and_then_differs_only_if_it_changed(root, figures):
    assert statuses(root)["subjects"].reasons == ("never made",)
    assert remake(root, figures["subjects"]) == ["subjects.txt: new"]
    assert not statuses(root)["subjects"].due
    text = root / FOLDER / "subjects.txt"
    printed = text.read_text()
    assert "a new person of the same population" in printed
    assert remake(root, figures["subjects"]) == []
    text.write_text(printed.replace("person", "robot"))
    assert statuses(root)["subjects"].reasons == ("subjects.txt edited",)
    (change,) = remake(root, figures["subjects"])
    assert change.startswith("subjects.txt: 2 lines differ")
    assert "\n  -" in change
    assert "a new robot" in change
    assert text.read_text() == printed
    assert not statuses(root)["subjects"].due


@pytest.mark.slow
def test_a_command_makes_text_and_pictures(root, figures):
    assert remake(root, figures["lift"]) == ["lift.txt: new", "lift.png: new"]
    folder = root / FOLDER
    assert (folder / "lift.txt").read_text().startswith("pictures/lift.png: smooth/S1 seed 0, RMSE")
    assert (folder / "lift.png").read_bytes().startswith(b"\x89PNG")
    assert remake(root, figures["lift"]) == []


def test_recordings_come_from_outside(root, figures, tmp_path):
    with pytest.raises(InputError, match=r"recorded needs lifts\.csv"):
        remake(root, figures["recorded"])
    lifts = tmp_path / "any name.csv"
    lifts.write_text("1\n2\n3\n")
    found = command_output(root, figures["recorded"], [lifts, tmp_path / "not used.csv"])
    assert found == {"recorded.txt": b"3\none.py\n120 1\n"}


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("failing", "failing: its command ended with 1"),
        ("without", "wrote no picture.png"),
    ],
)
def test_nothing_is_recorded_of_a_command_that_fails(root, figures, name, message):
    with pytest.raises(EvaluatorFault, match=message):
        remake(root, figures[name])
    assert statuses(root)[name].reasons == ("never made",)
    assert not (root / FOLDER / f"{name}.txt").exists()
