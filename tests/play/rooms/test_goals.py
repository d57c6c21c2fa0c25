"""Lifts in which a goal was missed: void for everybody, and counted nowhere."""

import json

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.bundle import read_bundle, results, write_bundle
from colift.benchmark.bundle.schema import results_schema
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.real_lifts.session_folder import EVENTS, lift_folders
from colift.benchmark.real_lifts.suites import played_lifts
from colift.benchmark.results.goals import goal_scores
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification.verify import verify
from jsonschema import ValidationError, validate

from .test_room import Table, hand_of

PARTNERS = ["copy", "simulated person", "person", "person as robot"]


@pytest.fixture
def table(tmp_path):
    made = Table(tmp_path / "session", {"copy": PolicySpec(text="copy")}, cue_seed=3)
    for seat in (0, 1):
        made.take(made.room.join(seat))
    yield made
    made.room.close()


def lifted(table, hand=None, partner="copy", kind="smooth"):
    """Lift with a hand of a cue, an honest one if none is given; return the last message of it."""
    table.say(0, type="choose", partner=partner, kind=kind)
    table.prepare()
    table.grip(0)
    two = partner.startswith("person")
    if two:
        table.grip(1)
    made = (hand or hand_of)(table.room._lifting.cue)
    follow = {1: lambda time: made(time - 0.1)} if two else {}
    table.lift({0: made, **follow})
    return next(told for _, told in reversed(table.told) if told["type"] in ("end", "void"))


def events(folder, kind):
    lines = (folder / EVENTS).read_text().splitlines()
    return [line for line in map(json.loads, lines) if line["event"] == kind]


def nobody(cue):
    return lambda time: 0.0


def jumping(cue):
    """Rest, and jump to the line 0.2 s before it is replaced."""
    _, back = cue.cues()
    return lambda time: cue.cues()[0].height if abs(time - back.frame / 100 + 0.1) < 0.1 else 0.0


def touching(cue):
    """Go to the line, and back before the next one appears."""
    back, honest = cue.cues()[1], hand_of(cue)
    return lambda time: 0.0 if time > back.frame / 100 - 0.5 else honest(time)


def short(cue):
    honest = hand_of(cue)
    return lambda time: 0.8 * honest(time)


def beyond(cue):
    honest = hand_of(cue)
    return lambda time: 1.2 * honest(time)


def staying_up(cue):
    honest, goal = hand_of(cue), cue.cues()[0].height
    return lambda time: honest(time) if time < cue.cues()[1].frame / 100 else goal


@pytest.mark.slow
@pytest.mark.parametrize("partner", PARTNERS)
@pytest.mark.parametrize("hand", [nobody, jumping, touching, short, beyond, staying_up])
def test_a_missed_goal_makes_a_lift_void(table, tmp_path, hand, partner):
    end = lifted(table, hand, partner)
    goal = "the height of rest" if hand is staying_up else "the line"
    assert end["type"] == "void"
    assert f"{goal} was not reached and held" in end["reason"]
    assert lift_folders(tmp_path / "session") == []
    assert not (tmp_path / "session" / "recordings.csv").exists()
    (event,) = events(tmp_path / "session", "void")
    assert event["reason"] == end["reason"]
    assert event["goal_errors_mm"][goal] > 20
    with pytest.raises(InputError, match="no lift that counts"):
        played_lifts(tmp_path / "session")


@pytest.mark.slow
@pytest.mark.parametrize("partner", PARTNERS)
def test_a_void_lift_is_repeated_with_the_same_goals_and_can_count(table, partner):
    void = lifted(table, nobody, partner)
    first = [told["height"] for _, told in table.told if told["type"] == "cue"]
    table.told.clear()
    end = lifted(table, None, partner)
    assert (void["type"], end["type"], end["lift"]) == ("void", "end", void["lift"])
    assert [told["height"] for _, told in table.told if told["type"] == "cue"] == first
    assert 0 <= end["goal_error_mm"] < 5


def test_the_goal_error_is_in_the_results_and_verified(table, tmp_path):
    end = lifted(table, kind="pause")
    folder = tmp_path / "session" / end["folder"]
    content = json.loads((folder / "results.json").read_text())
    validate(content, results_schema())
    assert content["goals"]["lifts"] == {"001-pause": end["goal_error_mm"]}
    assert content["goals"]["error_mm"] == {"mean": end["goal_error_mm"], "missing": 0}
    assert content["goals"]["missed"] == 0
    verdict = verify(folder)
    assert verdict.ok
    assert verdict.results.goals.lifts == content["goals"]["lifts"]


def rewritten(folder, change):
    """Write a bundle anew with changed results, as a forger or an earlier version would."""
    bundle = read_bundle(folder)
    content = dict(bundle.results)
    change(content)
    write_bundle(folder, bundle.run(), content, platform=bundle.platform)


def test_a_forged_goal_error_is_found(table, tmp_path):
    folder = tmp_path / "session" / lifted(table)["folder"]
    rewritten(folder, lambda content: content["goals"]["lifts"].update({"001-smooth": 0.5}))
    (finding,) = verify(folder).findings
    assert "goals.lifts.001-smooth says 0.5" in str(finding)
    with pytest.raises(ValidationError):
        validate({**read_bundle(folder).results, "goals": {}}, results_schema())


def test_an_older_bundle_claims_no_goal_error_and_is_verified(table, tmp_path):
    folder = tmp_path / "session" / lifted(table)["folder"]
    rewritten(folder, lambda content: content.pop("goals"))
    verdict = verify(folder)
    assert verdict.ok
    assert verdict.results.goals is None
    assert played_lifts(tmp_path / "session").suite.size == 1


def test_a_lift_of_an_older_session_in_which_nobody_moved_is_left_out(table, tmp_path, monkeypatch):
    """Earlier versions saved it; no other lift is lost by it."""
    with monkeypatch.context() as earlier:
        earlier.setattr("colift.play.rooms.room.missed_words", lambda goals: None)
        still = lifted(table, nobody)
    assert still["rmse_mm"] < 2
    honest = lifted(table)
    for end in (still, honest):
        rewritten(tmp_path / "session" / end["folder"], lambda content: content.pop("goals"))
    lifts = played_lifts(tmp_path / "session")
    assert [each.trial for each in lifts.suite.scenarios] == ["002-smooth"]
    assert [*lifts.left_out] == ["001-copy"]
    assert "the line was not reached" in lifts.left_out["001-copy"]
    assert all(verify(folder).ok for folder in lift_folders(tmp_path / "session"))


def test_every_policy_on_a_session_has_the_same_goal_errors(table, tmp_path):
    ends = [lifted(table, kind="mixed") for _ in range(2)]
    suite = played_lifts(tmp_path / "session").suite
    scores = goal_scores(suite)
    assert [*scores.lifts.values()] == [end["goal_error_mm"] for end in ends]
    mean = np.mean([*scores.lifts.values()])
    for name in ("hold", "copy"):
        content = results(run_suite(PolicySpec(text=name), suite), {})
        assert content.goals.lifts == scores.lifts
        assert content.plain()["goals"]["error_mm"]["mean"] == pytest.approx(mean)
        assert f"{mean:.1f} mm from their goals" in str(content.goals)


def test_other_lifts_have_no_goal_errors():
    assert goal_scores(make_suite("quick-v1")) is None


def test_only_the_leader_is_told_when_the_first_goal_comes(table):
    lifted(table, partner="person")
    first = [(seat, told["frame"]) for seat, told in table.told if told["type"] == "first"]
    cues = [told["frame"] for _, told in table.told if told["type"] == "cue"]
    assert first == [(0, cues[0])]


def test_each_person_is_told_what_to_do(table):
    table.say(0, type="choose", partner="person", kind="smooth")
    table.prepare()
    table.grip(0)
    told = {seat: each["message"] for seat, each in table.told if each["type"] == "state"}
    assert told == {
        0: "Hold still: the other hand is still open.",
        1: "Take hold of the table, both of you.",
    }
    table.grip(1)
    told = {seat: each["message"] for seat, each in table.told if each["type"] == "state"}
    assert told == {0: "Hold still: a line will appear.", 1: "Follow the table."}
    table.say(0, type="release")
    table.say(0, type="swap")
    for seat in (0, 1):
        table.grip(seat)
    told = {seat: each["message"] for seat, each in table.told if each["type"] == "state"}
    assert told == {1: "Hold still: a line will appear.", 0: "Follow the table."}
