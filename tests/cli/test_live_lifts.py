"""Sessions of live lifts on the command line: their goals, and the lifts that do not count."""

import json
import shutil

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.validity.sources import sources_of

from ..play.rooms.test_goals import lifted, nobody, rewritten
from ..play.rooms.test_room import Table

MISSED = "the line was not reached and held (the hand was "
STILL = f"001-copy does not count: {MISSED}"


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    """A session of three lifts; in the first, of an earlier version, nobody moved."""
    folder = tmp_path_factory.mktemp("live") / "session"
    table = Table(folder, {"copy": PolicySpec(text="copy")}, cue_seed=3)
    table.take(table.room.join(0))
    with pytest.MonkeyPatch.context() as earlier:
        earlier.setattr("colift.play.rooms.room.missed_words", lambda goals: None)
        still = lifted(table, nobody)
    rewritten(folder / still["folder"], lambda content: content.pop("goals"))
    ends = [lifted(table, kind=kind) for kind in ("pause", "changing_goal")]
    table.room.close()
    return folder, [end["goal_error_mm"] for end in ends]


def test_a_run_has_the_lifts_that_count_and_says_how_well_their_goals_were_reached(
    colift, session, tmp_path
):
    folder, errors = session
    done = colift("run", "copy", "--recordings", folder, "--out", tmp_path / "bundle")
    assert done.returncode == 0
    assert f"session: {STILL}" in done.stderr
    assert done.stderr.count("does not count") == 1
    said = f"the hands were {sum(errors) / 2:.1f} mm from their goals on average, with every policy"
    assert said in " ".join(done.stdout.split())
    content = json.loads((tmp_path / "bundle" / "results.json").read_text())
    assert content["summary"]["episodes"] == 2
    assert content["goals"]["lifts"] == pytest.approx(
        {"002-pause": errors[0], "003-changing_goal": errors[1]}
    )
    assert colift("verify", tmp_path / "bundle").returncode == 0


def test_a_comparison_has_the_goal_errors(colift, session):
    folder, errors = session
    done = colift("compare", "copy", "hold", "--recordings", folder, "--json")
    assert json.loads(done.stdout)["goals"]["error_mm"]["mean"] == pytest.approx(sum(errors) / 2)
    assert STILL in done.stderr


def test_a_verified_session_says_the_goal_error_of_each_lift_that_has_one(colift, session):
    folder, errors = session
    code, told, _ = colift("verify", folder)
    first, *others, count = told.splitlines()
    assert (code, count) == (0, "3 of 3 live lifts are verified.")
    assert "goals" not in first
    for line, error in zip(others, errors, strict=True):
        assert f"mm, {error:.1f} mm from its goals, equal to the bit" in line


def test_a_source_of_real_lifts_has_those_that_count(session):
    (source,) = sources_of([session[0]])
    assert source.suite.size == 2
    assert [*source.left_out] == ["001-copy"]


def test_a_session_in_which_nobody_moved_has_no_lift(colift, session, tmp_path):
    for name in ("001-copy", "001-other", "001-third", "001-fourth"):
        shutil.copytree(session[0] / "lifts" / "001-copy", tmp_path / "still" / "lifts" / name)
    done = colift("run", "copy", "--recordings", "still")
    assert done.returncode == 2
    assert f"this session has no lift that counts; 001-copy: {MISSED}" in done.stderr.replace(
        "\n", " "
    )
    assert "and 1 more" in done.stderr
    assert "Traceback" not in done.stderr
