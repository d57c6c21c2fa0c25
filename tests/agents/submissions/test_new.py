"""The template of a submission: where it is written, and where it is not."""

from pathlib import Path

import pytest
from colift.agents.submissions.new import write_template
from colift.agents.submissions.submission import read_submission
from colift.base.errors import InputError


@pytest.mark.parametrize(
    ("folder", "name"),
    [
        ("mine", "mine"),
        ("Fast policy", "Fast policy"),
        ("a/b/deep", "deep"),
        ("blend", "my-policy"),
        ("été", "t"),
        ("---", "my-policy"),
        ('x"y', "x-y"),
        ("n" * 60, "n" * 40),
    ],
)
def test_the_policy_is_called_as_its_folder_where_that_is_a_name(tmp_path, folder, name):
    write_template(tmp_path / folder)
    submission = read_submission(tmp_path / folder)
    assert submission.manifest.name == name
    assert submission.contents.paths == ("policy.py", "policy.toml")


def test_an_empty_folder_is_taken(tmp_path):
    (tmp_path / "mine").mkdir()
    write_template(tmp_path / "mine")
    assert read_submission(tmp_path / "mine").manifest.name == "mine"


def folder_with_a_file(path):
    path.mkdir()
    (path / "thesis.tex").write_text("years of work")


def folder_with_a_hidden_folder(path):
    path.mkdir()
    (path / ".git").mkdir()


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (folder_with_a_file, "mine is not empty; name a new folder"),
        (folder_with_a_hidden_folder, "mine is not empty; name a new folder"),
        (lambda path: path.touch(), "mine is there already; name a new folder"),
        (lambda path: path.symlink_to("/tmp"), "mine is there already; name a new folder"),
        (lambda path: path.symlink_to("/nowhere"), "mine is there already; name a new folder"),
    ],
)
def test_nothing_is_overwritten(tmp_path, make, told):
    make(tmp_path / "mine")
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(InputError, match=told):
        write_template(tmp_path / "mine")
    assert sorted(tmp_path.rglob("*")) == before


def test_a_place_that_cannot_be_written_is_told():
    with pytest.raises(InputError, match="cannot write to /proc/mine: "):
        write_template(Path("/proc/mine"))
