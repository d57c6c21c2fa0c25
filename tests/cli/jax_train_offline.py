"""``colift train clone`` and ``colift train iql`` as a user meets them; run by a process."""

import json

import pytest
from colift.benchmark.training import validation

FAST = ("--updates", "500", "--jobs", "1")


@pytest.fixture(autouse=True)
def two_lifts_to_validate(monkeypatch):
    monkeypatch.setattr(validation, "VALIDATION_SEEDS", validation.VALIDATION_SEEDS[:2])


@pytest.fixture
def data(colift, tmp_path):
    """Return the folder of a small set."""
    done = colift("export", "--set", "follow", "--lifts", "3", "--jobs", "1", "--out", "set")
    assert done.returncode == 0
    return tmp_path / "set"


def test_a_set_gives_policies_and_another_set_needs_another_folder(colift, data, tmp_path):
    done = colift("train", "clone", "set", "--seeds", "2", "--out", "out", *FAST)
    assert (done.returncode, done.stderr) == (0, "")
    assert "mean ± SD" in done.stdout
    manifest = (tmp_path / "out" / "seed-0" / "policy.toml").read_text()
    assert "lifts: the data set colift/follow-3-v0, SHA-256" in manifest

    colift("export", "--set", "follow", "--lifts", "2", "--jobs", "1", "--out", "less")
    other = colift("train", "clone", "less", "--out", "out", *FAST)
    assert other.returncode == 2
    assert "of another training: data is" in other.stderr


def test_a_policy_from_data_runs(colift, data):
    done = colift("train", "iql", "set", "--beta", "1", "--out", "out", *FAST)
    assert (done.returncode, done.stderr) == (0, "")
    options = ("--suite", "quick-v1", "--seeds", "40:41", "--jobs", "1", "--json")
    run = colift("run", "out/seed-0", *options)
    assert json.loads(run.stdout)["summary"]["failed"] == 0


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["/nowhere", "--out", "x"], "/nowhere: no Minari data set"),
        ([".", "--out", "x", "--updates", "7"], "updates must be a multiple of 500, got 7"),
        ([".", "--out", "x"], "no Minari data set: there is no metadata.json"),
    ],
)
def test_wrong_usage_is_one_clear_line_and_exit_code_2(colift, tmp_path, arguments, told):
    for trainer in ("clone", "iql"):
        done = colift("train", trainer, *arguments)
        assert done.returncode == 2
        assert told in done.stderr
        assert done.stderr.count("\n") == 1
        assert list(tmp_path.iterdir()) == []
