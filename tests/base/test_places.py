"""Places of results: tried before the work, and left as they were."""

import pytest
from colift.base.errors import InputError
from colift.base.places import check_beside, check_empty


def test_the_folders_above_a_place_are_made_and_stay_empty(tmp_path):
    check_beside(tmp_path / "a" / "b" / "new")
    assert [*(tmp_path / "a").iterdir()] == [tmp_path / "a" / "b"]
    assert [*(tmp_path / "a" / "b").iterdir()] == []


def test_a_place_beside_which_nothing_can_be_written_is_refused(tmp_path):
    (tmp_path / "file").touch()
    for folder, reason in (("file", "File exists"), ("file/more", "Not a directory")):
        with pytest.raises(InputError, match=f"cannot write to .*{folder}: {reason}"):
            check_beside(tmp_path / folder / "new")


def test_only_a_new_or_empty_folder_is_empty(tmp_path):
    check_empty(tmp_path / "new")
    check_empty(tmp_path)
    (tmp_path / "link").symlink_to("nowhere")
    with pytest.raises(InputError, match="link is there already; name a new folder"):
        check_empty(tmp_path / "link")
    with pytest.raises(InputError, match="is not empty; name a new folder"):
        check_empty(tmp_path)
    with pytest.raises(InputError, match=r"cannot read .*: File name too long"):
        check_empty(tmp_path / ("n" * 300))
