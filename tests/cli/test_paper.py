"""``colift paper`` as a user meets it; the report itself is tested where it is made."""


def test_seeds_must_be_a_range(colift, tmp_path):
    done = colift("paper", "--out", str(tmp_path / "report"), "--seeds", "12")
    assert done.returncode == 2
    assert "--seeds must be A:B" in done.stderr
    assert not (tmp_path / "report").exists()


def test_a_file_in_the_way_is_refused_before_any_work(colift, tmp_path):
    (tmp_path / "taken").write_text("mine")
    done = colift("paper", "--out", str(tmp_path / "taken"))
    assert done.returncode == 2
    assert "taken" in done.stderr
    assert (tmp_path / "taken").read_text() == "mine"
