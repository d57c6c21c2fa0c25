"""Replays of sessions: one session lift by lift, beside two people who know each other as long."""

import dataclasses

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import read_bundle, results, write_bundle
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import human_human_run
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.replays.chosen import choose_replays, chosen_replays
from colift.leaderboard.replays.html import replay_files
from colift.leaderboard.views.lifts import public_lifts, public_scores, session_of

WHOLE = make_suite("session-v1")
SUITE = dataclasses.replace(WHOLE, name="few", scenarios=WHOLE.scenarios[:3])


@pytest.fixture(scope="module")
def bundle(tmp_path_factory):
    path = tmp_path_factory.mktemp("session") / "bundle"
    run = run_suite(PolicySpec(text="recall"), SUITE)
    write_bundle(path, run, results(run, {}).plain(), human_human=None)
    return path


def test_a_median_session_is_shown_whole_and_then_the_worst_lift(bundle):
    episodes = read_bundle(bundle).episodes
    errors = [each.scores["rmse_mm"] for each in episodes]
    means = [sum(errors[first : first + 10]) for first in (0, 10, 20)]
    middle = 10 * means.index(sorted(means)[1])
    chosen = choose_replays(episodes, 10)
    assert [each.row for each in chosen] == [*range(middle, middle + 10), errors.index(max(errors))]
    assert [each.which for each in chosen] == [None] * 10 + ["worst"]


def test_two_people_beside_a_lift_know_each_other_from_the_lifts_before(bundle):
    replays = chosen_replays(read_bundle(bundle), "recall")
    assert [each["lift"] for each in replays[:10]] == list(range(1, 11))
    assert list(replay_files(replays)) == [f"habitual-{n}" for n in range(1, 11)] + [
        "habitual-worst"
    ]
    people = {
        (each.subject, each.seed): each.scores["rmse_mm"]
        for each in human_human_run(SUITE).episodes
    }
    for each in replays:
        theirs = people[each["subject"], each["seed"]]
        assert each["ghost"]["rmse_mm"] == pytest.approx(theirs, abs=1e-4)


def test_the_lifts_that_count_are_the_parts_of_a_row(bundle):
    lifts, curve = public_lifts(bundle), session_of(bundle)
    assert (len(lifts), len(curve.rmse_mm), curve.counted) == (30, 10, 3)
    counted = [each.rmse_mm for i, each in enumerate(lifts) if i % 10 >= 7]
    assert list(public_scores(bundle).rmse_mm) == counted
