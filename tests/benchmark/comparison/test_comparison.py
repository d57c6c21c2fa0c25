"""Ranks, differences and smoothness of policies whose scores are known."""

import dataclasses

import numpy as np
import pytest
from colift.benchmark.comparison.captions import parts_caption, picture_caption, unit_warnings
from colift.benchmark.comparison.compare import Comparison, compare
from colift.benchmark.comparison.files import comparison_json
from colift.benchmark.comparison.html import html_page
from colift.benchmark.comparison.paired_results import PolicyResults
from colift.benchmark.comparison.ranking import RankedPolicy, Ranking
from colift.benchmark.statistics import paired_permutation_p

from .conftest import DIFFICULTY, SUBJECTS, paired, policy_results


def named(ranking: Ranking, name: str) -> RankedPolicy:
    return next(ranked for ranked in ranking.policies if ranked.name == name)


def errors(comparison: Comparison, name: str) -> np.ndarray:
    (policy,) = [policy for policy in comparison.results.policies if policy.name == name]
    return np.array(policy.scores.rmse_mm)


def test_the_order_is_that_of_the_mean_error(comparison: Comparison) -> None:
    assert [ranked.name for ranked in comparison.overall.policies] == [
        "leader",
        "twin",
        "follower",
        "failing",
        "still",
    ]


def test_policies_that_cannot_be_told_apart_share_a_rank(comparison: Comparison) -> None:
    smooth = comparison.behaviours[0]
    assert (smooth.name, named(smooth, "leader").rank, named(smooth, "twin").rank) == (
        "smooth",
        1,
        1,
    )
    assert named(smooth, "follower").rank == 3
    assert named(smooth, "failing").rank == 3, "two ruined people prove nothing, but help nobody"
    assert named(smooth, "still").rank == 4


def test_each_behaviour_has_its_own_winner(comparison: Comparison) -> None:
    winners = {ranking.name: ranking.policies[0].name for ranking in comparison.behaviours}
    assert winners["jerky"] == "follower"
    assert winners["smooth"] in ("leader", "twin")
    assert [ranking.name for ranking in comparison.subjects] == list(SUBJECTS)
    assert [ranking.episodes for ranking in comparison.behaviours] == [16] * 4


def test_differences_are_to_the_best_on_the_same_lifts(comparison: Comparison) -> None:
    overall = comparison.overall
    assert overall.policies[0].to_best is None
    behind = named(overall, "still").to_best
    assert behind is not None
    difference = errors(comparison, "still") - errors(comparison, "leader")
    assert behind.mean == pytest.approx(difference.mean())
    assert behind.ci95[0] < behind.mean < behind.ci95[1]
    assert behind.share_better == 0.0
    units = comparison.results.human_human.units
    raw = paired_permutation_p(errors(comparison, "leader"), errors(comparison, "still"), units)
    assert raw <= behind.p <= 0.04
    twin = named(overall, "twin").to_best
    assert twin is not None
    assert twin.p > 0.05
    assert twin.ci95[0] < 0.0 < twin.ci95[1]


def test_a_policy_as_good_as_two_people_has_a_ratio_of_one(comparison: Comparison) -> None:
    jerky = named(comparison.behaviours[2], "follower")
    assert jerky.vs_human.mean == pytest.approx(0.9, abs=0.002)
    assert jerky.better_than_human > 0.99
    leader = named(comparison.overall, "leader")
    ratios = errors(comparison, "leader") / DIFFICULTY
    assert leader.vs_human.mean == pytest.approx(np.exp(np.log(ratios).mean()))
    assert leader.better_than_human < 0.01
    assert leader.vs_human.ci95[0] < leader.vs_human.mean < leader.vs_human.ci95[1]


def test_failed_lifts_count_and_are_counted(comparison: Comparison) -> None:
    failing = named(comparison.overall, "failing")
    assert failing.failed == 3
    assert failing.rmse_mm.mean == pytest.approx((3 * 250 + 61 * 30) / 64)
    assert failing.scores.metric("sparc").missing == 3


def test_holding_still_has_no_smoothness(comparison: Comparison) -> None:
    still = named(comparison.overall, "still")
    assert still.metrics["sparc"] is None
    assert still.scores.metric("sparc").missing == 64


def test_the_front_leaves_out_who_is_beaten_in_both(comparison: Comparison) -> None:
    """The twin is less level and less smooth than the leader; failing is smooth in some lifts."""
    assert comparison.front == ("leader", "follower")


def test_with_four_people_in_a_behaviour_none_is_the_best_there() -> None:
    def few(made: PolicyResults) -> PolicyResults:
        members = range(0, len(made.scores.strata), 5)
        return dataclasses.replace(made, scores=made.scores.select(members))

    better, worse = (
        few(policy_results("better", 5.0, -2.0)),
        few(policy_results("worse", 200.0, -2.0)),
    )
    full = paired()
    human_human = dataclasses.replace(
        full.human_human, strata=better.scores.strata, values={"rmse_mm": (10.0,) * 13}
    )
    made = compare(dataclasses.replace(full, policies=(better, worse), human_human=human_human))
    assert [ranking.episodes for ranking in made.behaviours] == [4, 3, 3, 3]
    for ranking in made.behaviours:
        assert not any(ranking.best(ranked) for ranked in ranking.policies)
    assert [made.overall.best(ranked) for ranked in made.overall.policies] == [True, False]
    assert parts_caption("behaviour", made.behaviours).endswith(
        "No policy is marked as the best: 4 people are too few for any difference."
    )
    by_behaviour = html_page(made).split("<h2>By behaviour</h2>")[1].split("<h2>By subject</h2>")[0]
    assert 'class="best"' not in by_behaviour
    told = comparison_json(made)
    assert [part["decisive"] for part in (told, *told["behaviours"])] == [True] + [False] * 4


def test_a_front_of_one_has_no_line_and_equal_tables_are_shown_once(comparison: Comparison) -> None:
    axes = comparison.results.axes
    assert "The line joins the Pareto front: " in picture_caption(axes, ("leader", "follower"))
    alone = picture_caption(axes, ("leader",))
    assert "line joins" not in alone
    assert "leader alone is the Pareto front" in alone
    full = comparison.results
    labels = {subject: f"{subject} of one" for _, subject in full.human_human.strata}
    assert len(labels) > 1
    # Each behaviour with one subject of its own.
    strata = tuple((f"by {labels[subject]}", subject) for _, subject in full.human_human.strata)
    single = dataclasses.replace(
        full,
        policies=tuple(
            dataclasses.replace(each, scores=dataclasses.replace(each.scores, strata=strata))
            for each in full.policies
        ),
        human_human=dataclasses.replace(full.human_human, strata=strata),
    )
    assert not comparison.one_each
    assert "By subject" in html_page(comparison)
    page = html_page(compare(single))
    assert "By behaviour" in page
    assert "By subject" not in page


def test_where_lifts_are_enough_the_best_are_marked(comparison: Comparison) -> None:
    marked = [
        [ranked.name for ranked in ranking.policies if ranking.best(ranked)]
        for ranking in comparison.behaviours
    ]
    assert all(marked)
    assert set(marked[0]) == {"leader", "twin"}


def test_actions_that_are_hardly_in_metres_are_told() -> None:
    def clipped(name: str, share: float) -> PolicyResults:
        made = policy_results(name, 20.0, -2.0)
        values = {**made.scores.values, "clipped": (share,) * len(made.scores.strata)}
        return dataclasses.replace(made, scores=dataclasses.replace(made.scores, values=values))

    made = compare(paired(clipped("millimetres", 0.98), clipped("metres", 0.02)))
    (told,) = unit_warnings(made)
    assert told.startswith("millimetres: 98 % of its actions were clipped")
    assert {s.name: s.clipped for s in made.overall.policies} == pytest.approx(
        {"millimetres": 0.98, "metres": 0.02}
    )
