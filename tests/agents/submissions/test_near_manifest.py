"""A submission without a manifest: what is there instead is named, with the cure."""

import pytest
from colift.agents.submissions.near_manifest import NAME, files_of, near_manifest


@pytest.mark.parametrize(
    ("paths", "told"),
    [
        ([], "it is empty: it holds no file of a submission"),
        (
            ["mine/mine/policy.py", "mine/mine/policy.toml"],
            "found mine/mine/policy.toml: pack the folder that contains it, mine/mine",
        ),
        (
            ["README.md", "sub/policy.toml"],
            "found sub/policy.toml: pack the folder that contains it, sub",
        ),
        (["a/policy.toml", "b/policy.toml"], "found a/policy.toml, b/policy.toml: pack one of the"),
        (["policy.py", "policy.toml.txt"], "found policy.toml.txt: rename it to policy.toml (some"),
        (["mine/policy.toml.TXT"], "found mine/policy.toml.TXT: rename it to policy.toml (some"),
        (["Policy.py", "POLICY.TOML"], "found POLICY.TOML: rename it to policy.toml, in small"),
        (["policy.tml"], "found policy.tml: rename it to policy.toml, if it is the manifest"),
        (["policies.toml"], "found policies.toml: rename it to policy.toml, if it is"),
    ],
)
def test_a_near_miss_is_named_with_its_cure(paths, told):
    assert told in near_manifest(paths, "it")


def test_of_a_folder_on_the_disk_the_right_one_is_to_be_given():
    told = near_manifest(["mine/policy.toml"], "it", NAME)
    assert told == (
        "it has no policy.toml; found mine/policy.toml: give the folder that contains it, mine"
    )


@pytest.mark.parametrize("paths", [["policy.py"], ["pyproject.toml", "policy.py"], ["a/b/c.txt"]])
def test_nothing_near_is_no_near_miss(paths):
    assert near_manifest(paths, "it") is None


def test_the_files_of_a_folder_are_searched_to_a_limit(tmp_path):
    (tmp_path / "mine/mine").mkdir(parents=True)
    (tmp_path / ".git").mkdir()
    for name in ("mine/mine/policy.toml", ".git/policy.toml", "Thumbs.db", "a"):
        (tmp_path / name).touch()
    assert files_of(tmp_path) == ("a", "mine/mine/policy.toml")
    assert len(files_of(tmp_path, most=1)) == 1
