import dataclasses
import itertools
import json
import math

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.trace import Trace
from colift.benchmark.execution.playing import play
from colift.benchmark.results.baselines import human_human_run
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.replays.replay import changes, play_ghost, replay_content

SCENARIO = make_scenario("pause", "S2")


@pytest.fixture(scope="module")
def episode():
    return next(play(PolicySpec(text="blend"), SCENARIO, (3,)))


@pytest.fixture(scope="module")
def ghost():
    return play_ghost(SCENARIO, 3)


@pytest.fixture(scope="module")
def made(episode, ghost):
    return replay_content(episode, SCENARIO, ghost, policy="blend")


def heights(series):
    return 1e-4 * np.array(list(itertools.accumulate(series)))


def test_heights_are_the_trace_to_a_twentieth_of_a_millimetre(made, episode):
    for name, series in (
        ("human", episode.trace.human_end),
        ("robot", episode.trace.robot_end),
        ("target", episode.trace.target),
    ):
        assert np.abs(heights(made[name]) - series).max() <= 0.5e-4 + 1e-12


def test_the_error_follows_from_the_drawn_heights(made, episode):
    drawn = 1000 * (heights(made["human"]) - heights(made["robot"]))
    assert np.sqrt(np.mean(drawn**2)) == pytest.approx(episode.scores["rmse_mm"], abs=0.05)
    assert made["scores"]["rmse_mm"] == round(episode.scores["rmse_mm"], 4)


def test_commands_are_those_of_the_episode():
    with_wild_actions = [0.03, 0.5, -9.0, 0.02, *[0.04] * 12, -0.01]
    lift = Lift(SCENARIO)
    lift.reset(0)
    seen = []
    for action in with_wild_actions:
        lift.step(np.zeros(10), np.array([action]))
        seen.append(lift.command)
    lift.close()
    assert SCENARIO.seat.hand_commands(with_wild_actions, SCENARIO.control_period) == pytest.approx(
        seen, abs=1e-12
    )


def test_it_says_what_the_policy_said(made, episode):
    said = episode.trace.internals
    assert np.allclose(1e-4 * np.array(made["prediction"]), said["prediction"], atol=0.5e-4)
    assert np.allclose(1e-3 * np.array(made["confidence"]), said["confidence"], atol=0.5e-3)
    assert len(made["command"]) == len(made["confidence"]) == len(episode.trace.action)


def test_a_policy_that_says_nothing_or_nonsense_is_replayed(episode, ghost):
    steps = len(episode.trace.action)
    strange = np.full(steps, np.nan)
    strange[1], strange[2] = 1e300, -np.inf
    internals = {"prediction": strange, "confidence": np.full(steps, np.nan)}
    trace = dataclasses.replace(episode.trace, internals=internals)
    made = replay_content(dataclasses.replace(episode, trace=trace), SCENARIO, ghost, policy="odd")
    assert made["prediction"][:4] == [None, 2**15 - 1, None, None]
    assert made["confidence"] is made["role"] is None
    json.dumps(made, allow_nan=False)


def test_the_ghost_is_the_human_human_baseline_in_the_same_episode(made, episode, ghost):
    suite = dataclasses.replace(make_suite("quick-v1"), scenarios=(SCENARIO,), seeds=(3,))
    (human_human,) = human_human_run(suite).episodes
    assert ghost.episode.trace.digest() == human_human.trace.digest()
    assert np.array_equal(ghost.episode.trace.target, episode.trace.target)
    assert made["ghost"]["rmse_mm"] == round(human_human.scores["rmse_mm"], 4)
    assert heights(made["ghost"]["robot"]) == pytest.approx(
        human_human.trace.robot_end, abs=0.51e-4
    )


def test_events_say_when_the_human_pauses(made, episode):
    events = dict(made["events"])
    still = slice(events["pause"], events["resume"])
    assert np.ptp(episode.trace.target[still]) == 0.0
    assert np.ptp(episode.trace.target[: events["pause"]]) > 0.05


def test_a_lift_that_failed_before_it_began_has_no_heights(episode, ghost):
    empty = np.zeros(0)
    steps = np.zeros((0, 1))
    trace = Trace(
        **dict.fromkeys(set(Trace.series()) - {"action", "human_action"}, empty),
        action=steps,
        human_action=np.zeros((0, 10)),
        state=np.zeros((0, 16), np.uint8),
    )
    scores = {**episode.scores, "rmse_mm": 250.0, "sparc": math.nan}
    failed = dataclasses.replace(
        episode, trace=trace, scores=scores, failure="start: \x1b[31m</script>\n!"
    )
    made = replay_content(failed, SCENARIO, ghost, policy="bad")
    assert (made["human"], made["command"], made["scores"]["sparc"]) == ([], [], None)
    assert made["failure"].isprintable()
    assert made["horizon"] == len(ghost.episode.trace.human_end)


def test_changes_do_not_drift():
    series = np.cumsum(np.full(5000, 0.33e-4))
    assert np.abs(heights(changes(series)) - series).max() <= 0.5e-4 + 1e-9


def test_a_replay_has_the_series_that_its_task_draws_and_only_those(made):
    assert "drawn" not in made
    scenario = make_scenario("pivot", "S2", task="intent")
    episode = next(play(PolicySpec(text="pose_bayes"), scenario, (0,)))
    content = replay_content(episode, scenario, play_ghost(scenario, 0), policy="pose_bayes")
    (drawn,) = content["drawn"]
    assert (drawn["name"], drawn["where"], drawn["goal"]) == ("far_target", "robot", True)
    far = episode.trace.added["far_target"]
    assert np.abs(heights(drawn["values"]) - far).max() <= 0.5e-4 + 1e-12


def test_a_replay_has_the_hurdles_of_its_lift_with_what_the_scores_say():
    scenario = make_scenario("own_hurdle", "S2", task="agree")
    episode = next(play(PolicySpec(text="agree_leader"), scenario, (0,)))
    content = replay_content(episode, scenario, play_ghost(scenario, 0), policy="agree_leader")
    assert "drawn" not in content
    (hurdle,) = content["hurdles"]
    assert (hurdle["label"], hurdle["where"]) == ("human's hurdle", "human")
    window = slice(hurdle["start"], hurdle["stop"])
    height = episode.trace.added["human_hurdle"]
    assert np.ptp(height[window]) == 0.0
    assert hurdle["height"] == round(1e4 * height[window][0])
    assert hurdle["missed"] == round(10 * episode.scores["human_hurdle_mm"])


def test_the_body_at_the_robots_end_is_stated_unless_it_is_a_nao(made, episode, ghost, monkeypatch):
    assert "holder" not in made
    person = dataclasses.replace(SCENARIO, partner="live")
    assert replay_content(episode, person, ghost, policy="Ann")["holder"] == "person"
    monkeypatch.setattr("colift.leaderboard.replays.replay.shown_body", lambda partner: None)
    other = dataclasses.replace(SCENARIO, partner="iiwa")
    content = replay_content(episode, other, ghost, policy="lift")
    assert content["holder"] == "no picture of the robot iiwa"
