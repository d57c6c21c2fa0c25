import dataclasses

import pytest
from colift.leaderboard.replays.chosen import choose_replays


def lifts(bundle, behaviour, errors):
    like = bundle.episodes[0]
    return [
        dataclasses.replace(like, behaviour=behaviour, scores={**like.scores, "rmse_mm": error})
        for error in errors
    ]


@pytest.mark.parametrize(
    ("errors", "rows"),
    [
        ([5.0, 3.0, 9.0, 4.0, 7.0], {"best": 1, "median": 0, "worst": 2}),
        ([5.0, 3.0, 9.0, 4.0], {"best": 1, "median": 3, "worst": 2}),
        ([4.0, 4.0, 4.0], {"best": 0, "median": 1, "worst": 2}),
        ([4.0, 2.0], {"best": 1, "worst": 0}),
        ([4.0], {"median": 0}),
        ([], {}),
    ],
)
def test_best_median_and_worst_are_shown(bundle, errors, rows):
    found = choose_replays(lifts(bundle, "pause", errors))
    assert {each.which: each.row for each in found} == rows


def test_each_behaviour_has_its_own(bundle):
    found = choose_replays(bundle.episodes)
    assert [each.behaviour for each in found[::3]] == ["smooth", "pause", "jerky", "changing_goal"]
    for each in found:
        assert bundle.episodes[each.row].behaviour == each.behaviour
