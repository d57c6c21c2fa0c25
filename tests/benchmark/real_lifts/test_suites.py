"""Recordings as suites: scaled, or as they were."""

import numpy as np
import pytest
from colift.agents.humans import LIVE_SUBJECT
from colift.base.errors import InputError
from colift.benchmark.bundle import Recipe
from colift.benchmark.real_lifts.suites import real_lifts

TIMES = np.arange(0.0, 4.0, 0.02)


def write(path, tops):
    """Write a lift for each top height [m], each with a later peak than the one before."""
    rows = [
        f"{name},{time:.2f},{top * np.sin(np.pi * (time / 4) ** (1 + 0.1 * i)) ** 2:.5f},{name[0]}"
        for i, (name, top) in enumerate(tops.items())
        for time in TIMES
    ]
    path.write_text("trial,t_s,z_m,person\n" + "\n".join(rows) + "\n")
    return path


@pytest.fixture
def path(tmp_path):
    return write(tmp_path / "lifts.csv", {"a1": 0.2, "a2": 0.25, "b1": 0.15, "b2": 0.35})


def test_the_two_ways_of_playing_have_names_and_digests_of_their_own(path):
    scaled, own = real_lifts(path).suite, real_lifts(path, as_recorded=True).suite
    assert (scaled.name, own.name) == (
        "recordings lifts.csv",
        "recordings lifts.csv as recorded",
    )
    assert scaled.digest != own.digest
    assert {each.subject for each in own.scenarios} == {LIVE_SUBJECT}
    assert [each.person for each in own.scenarios] == ["a", "a", "b"]


def test_lifts_beyond_the_robots_stroke_are_left_out_by_name(path):
    lifts = real_lifts(path, as_recorded=True)
    assert [each.trial for each in lifts.suite.scenarios] == ["a1", "a2", "b1"]
    assert dict(lifts.left_out) == {
        "b2": "as recorded it goes from 0.00 to 0.35 m about its start, must be within -0.03 to "
        "0.29 m"
    }
    taller = real_lifts(path, as_recorded=True, robot="iiwa")
    assert (taller.suite.size, dict(taller.left_out)) == (4, {})


def test_a_file_without_a_lift_within_reach_is_refused(tmp_path):
    path = write(tmp_path / "high.csv", {"a": 0.6, "b": 0.7})
    with pytest.raises(
        InputError, match=r"high.csv: no lift can be played as recorded, only scaled; a: as .*"
    ):
        real_lifts(path, as_recorded=True)


def test_a_bundles_recipe_keeps_the_way_of_playing(path):
    for as_recorded in (False, True):
        suite = real_lifts(path, as_recorded=as_recorded).suite
        recipe = Recipe.of(suite)
        assert Recipe.parse(recipe.plain(), recipe.recordings).suite().digest == suite.digest


def test_what_is_measured_beside_the_hand_changes_no_digest(path):
    before = real_lifts(path, as_recorded=True).suite.digest
    lines = path.read_text().splitlines()
    far = [f"{line},{float(line.split(',')[2]) - 0.01:.5f}" for line in lines[1:]]
    path.write_text("\n".join([f"{lines[0]},z_far_m", *far]) + "\n")
    assert real_lifts(path, as_recorded=True).suite.digest == before
