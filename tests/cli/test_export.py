"""``colift export`` as a user meets it."""

import json

import pytest

minari = pytest.importorskip("minari")
parquet = pytest.importorskip("pyarrow.parquet")


@pytest.fixture
def bundle(colift, tmp_path):
    options = ("--suite", "quick-v1", "--seeds", "40:41", "--jobs", "1", "--out", "bundle")
    assert colift("run", "copy", *options).returncode == 0
    return tmp_path / "bundle"


def test_a_bundle_is_exported_in_both_formats(colift, bundle, tmp_path):
    for form, view in (("minari", "both"), ("lerobot", "robot")):
        done = colift("export", "bundle", "--to", form, "--view", view, "--out", form)
        assert (done.returncode, done.stderr) == (0, "")
        assert done.stdout.endswith(f"written: {form}\nEach lift was replayed: equal to the bit.\n")
        assert done.stdout.startswith("12 lifts, ")
        card = (tmp_path / form / "README.md").read_text()
        assert "colift export bundle --to" in card
        digest = json.loads((bundle / "results.json").read_text())["suite_digest"]
        assert digest in card
    assert len(minari.MinariDataset(tmp_path / "minari" / "data")) == 12
    info = json.loads((tmp_path / "lerobot" / "meta" / "info.json").read_text())
    assert parquet.read_table(tmp_path / "lerobot" / "data").num_rows == info["total_frames"]


def test_a_set_is_the_same_with_more_workers(colift, tmp_path):
    for name, jobs in (("one", 1), ("other", 2)):
        done = colift("export", "--set", "mixed", "--lifts", "3", "--jobs", jobs, "--out", name)
        assert (done.returncode, done.stderr) == (0, "")
    one, other = (tmp_path / name / "data" / "main_data.hdf5" for name in ("one", "other"))
    assert one.read_bytes() == other.read_bytes()


def test_a_changed_bundle_is_refused_and_nothing_is_left(colift, bundle, tmp_path):
    traces = bundle / "traces.npz"
    traces.write_bytes(traces.read_bytes()[:-1])
    before = sorted(tmp_path.iterdir())
    done = colift("export", "bundle", "--out", "set")
    assert done.returncode == 2
    assert done.stderr.startswith("error: bundle: traces.npz: ")
    assert done.stderr.count("\n") == 1
    assert sorted(tmp_path.iterdir()) == before


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ([], "name either a result bundle, or a fixed set by --set"),
        (["x", "--set", "follow", "--out", "y"], "name either a result bundle, or a fixed set"),
        (["x"], "--out DIR is missing"),
        (["/nowhere", "--out", "y"], "/nowhere: no such folder; name that of a result bundle"),
        ([".", "--out", "y"], ". has no results.json: name the folder of a result bundle"),
        (["x", "--out", "y", "--to", "rlds"], "--to must be minari or lerobot, got 'rlds'"),
        (["x", "--out", "y", "--view", "all"], "--view must be robot or both, got 'all'"),
        (["x", "--out", "y", "--lifts", "3"], "--lifts and --recordings need --set"),
        (["x", "--out", "."], "is there already"),
        (["x", "--out", "/dev/null"], "is a file"),
        (["--set", "all", "--out", "y"], "unknown set 'all'; known: follow, human, mixed"),
        (["--set", "recorded", "--out", "y"], "--recordings FILE.csv"),
        (["--set", "recorded", "--recordings", "/no.csv", "--out", "y"], "/no.csv"),
        (["--set", "follow", "--lifts", "0", "--out", "y"], "--lifts must be from 1"),
    ],
)
def test_wrong_usage_is_one_clear_line_and_exit_code_2(colift, tmp_path, arguments, told):
    done = colift("export", *arguments)
    assert done.returncode == 2
    assert told in done.stderr
    assert done.stderr.startswith("error:")
    assert done.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
