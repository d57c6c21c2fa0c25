import shutil

import pytest
from colift.base.errors import InputError
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.replays.chosen import FILE, chosen_replays, replays_of


@pytest.fixture(scope="module")
def replays(bundle):
    return chosen_replays(bundle, "blend")


def test_the_replays_of_a_run_are_small_and_of_public_lifts(replays, bundle):
    assert len(replays) == 12
    known = {(s.behaviour, s.subject.name) for s in make_suite("quick-v1").scenarios}
    for each in replays:
        assert (each["behaviour"], each["subject"]) in known
        assert each["seed"] == 0
        lift = (each["behaviour"], each["subject"])
        same = [e for e in bundle.episodes if (e.behaviour, e.subject) == lift]
        assert round(same[0].scores["rmse_mm"], 4) == each["scores"]["rmse_mm"]


def test_the_best_is_better_than_the_worst(replays):
    for best, median, worst in zip(replays[::3], replays[1::3], replays[2::3], strict=True):
        errors = [each["scores"]["rmse_mm"] for each in (best, median, worst)]
        assert errors == sorted(errors)
        assert [each["which"] for each in (best, median, worst)] == ["best", "median", "worst"]


def test_they_are_made_once(bundle_folder, tmp_path, replays):
    entry = tmp_path / "entry"
    shutil.copytree(bundle_folder, entry / "bundle")
    assert replays_of(entry / "bundle", "blend") == replays
    assert (entry / FILE).stat().st_size < 200_000
    shutil.rmtree(entry / "bundle")
    assert replays_of(entry / "bundle", "blend") == replays


def test_part_of_a_bundle_has_none(bundle_folder, tmp_path):
    shutil.copytree(bundle_folder, tmp_path / "bundle")
    (tmp_path / "bundle" / "traces.npz").unlink()
    assert replays_of(tmp_path / "bundle", "blend") == []


def test_a_changed_bundle_is_refused(bundle_folder, tmp_path):
    shutil.copytree(bundle_folder, tmp_path / "bundle")
    text = (tmp_path / "bundle" / "episodes.csv").read_text()
    (tmp_path / "bundle" / "episodes.csv").write_text(text.replace("pause", "jerky", 1))
    with pytest.raises(InputError, match="SHA-256"):
        replays_of(tmp_path / "bundle", "blend")
