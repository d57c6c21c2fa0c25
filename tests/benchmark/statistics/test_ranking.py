import itertools

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.statistics import (
    decisive,
    holm_correction,
    paired_permutation_p,
    rank_groups,
)

N = 60
LIFTS = np.repeat(np.linspace(5.0, 40.0, 4), 15)


def policies(*means: float, spread: float = 1.0, seed: int = 0) -> dict[str, np.ndarray]:
    """Return errors on the same lifts, of policies "a", "b", ... with exactly these means."""
    rng = np.random.default_rng(seed)
    noise = rng.normal(0.0, spread, (len(means), N))
    noise -= noise.mean(axis=1, keepdims=True)
    return {
        chr(ord("a") + i): LIFTS + mean + row
        for i, (mean, row) in enumerate(zip(means, noise, strict=True))
    }


@pytest.fixture(params=range(4))
def board(request: pytest.FixtureRequest) -> dict[str, np.ndarray]:
    """Seven policies about as far apart as can just be told."""
    rng = np.random.default_rng(request.param)
    return policies(*rng.uniform(0.0, 1.5, 7), seed=request.param)


def test_clearly_different_policies_each_have_a_rank() -> None:
    assert rank_groups(policies(2.0, 0.0, 4.0)) == (("b",), ("a",), ("c",))


def test_two_equal_policies_share_a_group() -> None:
    errors = policies(0.0, 3.0)
    errors["z"] = errors["b"].copy()
    assert rank_groups(errors) == (("a",), ("b", "z"))


def test_policies_that_cannot_be_told_apart_share_a_group() -> None:
    assert rank_groups(policies(0.0, 0.05, 5.0)) == (("a", "b"), ("c",))


def test_the_order_of_the_input_does_not_matter(board: dict[str, np.ndarray]) -> None:
    expected = rank_groups(board)
    for order in list(itertools.permutations(board))[:: 5040 // 6]:
        assert rank_groups({name: board[name] for name in order}) == expected


def test_groups_follow_the_means(board: dict[str, np.ndarray]) -> None:
    listed = [name for group in rank_groups(board) for name in group]
    assert listed == sorted(board, key=lambda name: board[name].mean())


def test_only_those_that_can_be_told_from_the_anchor_open_a_group(
    board: dict[str, np.ndarray],
) -> None:
    groups = rank_groups(board)
    for index, (anchor, *members) in enumerate(groups):
        behind = [*members, *(name for group in groups[index + 1 :] for name in group)]
        ps = holm_correction([paired_permutation_p(board[anchor], board[b]) for b in behind])
        assert (ps[: len(members)] > 0.05).all()
        assert (ps[len(members) : len(members) + 1] <= 0.05).all()


def test_groups_do_not_chain() -> None:
    """Neighbours cannot be told apart, the first and the last can: they share no group."""
    errors = policies(*np.arange(0.0, 2.1, 0.2))
    steps = list(zip(list(errors)[:-1], list(errors)[1:], strict=True))
    assert all(paired_permutation_p(errors[x], errors[y]) > 0.05 for x, y in steps)
    assert len(rank_groups(errors)) >= 3


def test_a_worse_policy_far_behind_does_not_change_who_shares_with_the_best() -> None:
    few = rank_groups(policies(0.0, 0.05, 2.0))
    assert few[0] == ("a", "b")
    assert rank_groups(policies(0.0, 0.05, 2.0, 90.0))[0] == ("a", "b")


def test_equal_policies_are_told_apart_in_at_most_five_percent_of_the_boards() -> None:
    rng = np.random.default_rng(3)
    wrong = sum(
        len(rank_groups({name: rng.normal(size=20) for name in "abcd"}, resamples=400)) > 1
        for _ in range(400)
    )
    assert 0 < wrong <= 0.08 * 400


def test_one_policy_or_none() -> None:
    assert rank_groups({"a": [1.0, 2.0]}) == (("a",),)
    assert rank_groups({}) == ()


def test_needs_the_same_episodes() -> None:
    with pytest.raises(InputError, match="pairs are needed"):
        rank_groups({"a": [1.0, 2.0], "b": [1.0]})


@pytest.mark.parametrize("behind", [1, 2, 4])
@pytest.mark.parametrize("episodes", range(1, 11))
def test_what_is_decisive_can_be_told_apart_and_nothing_else(behind, episodes):
    """However clear the differences are: the number of episodes decides."""
    errors = {f"p{k}": np.full(episodes, 1.0 + 100.0 * k) for k in range(behind + 1)}
    apart = len(rank_groups(errors, resamples=100_000)) > 1
    assert decisive(behind + 1, episodes) == apart


def plain_groups(errors: dict[str, np.ndarray]) -> tuple[tuple[str, ...], ...]:
    """Return the groups by tests of every anchor against all behind it."""
    waiting, groups = sorted(errors, key=lambda name: errors[name].mean()), []
    while waiting:
        anchor, *behind = waiting
        flips = max(10_000, 40 * len(errors))
        ps = [paired_permutation_p(errors[anchor], errors[b], resamples=flips) for b in behind]
        apart = holm_correction(ps) <= 0.05
        size = 1 + (int(apart.argmax()) if apart.any() else len(behind))
        groups.append(tuple(waiting[:size]))
        waiting = waiting[size:]
    return tuple(groups)


@pytest.mark.parametrize("seed", range(8))
def test_what_is_not_tested_because_it_is_far_away_would_have_been_told_apart(seed: int) -> None:
    """With clear and unclear differences, in some or in all lifts, and with ruined lifts."""
    rng = np.random.default_rng(seed)
    lifts = rng.gamma(2.0, 5.0, 40)
    errors = {
        f"p{i}": lifts
        + mean
        + rng.normal(0.0, 3.0, 40) * (rng.random(40) < (0.2, 1.0)[seed % 2])
        + 100.0 * (rng.random(40) < 0.03)
        for i, mean in enumerate(rng.uniform(0.0, 20.0, 25))
    }
    assert rank_groups(errors) == plain_groups(errors)


def test_of_a_thousand_policies_those_that_can_be_told_apart_are() -> None:
    """A cluster of equals, one that is better and one that is worse than all of them."""
    rng = np.random.default_rng(0)
    lifts = rng.gamma(2.0, 5.0, 100)
    errors = {f"p{i}": lifts + 10.0 + rng.normal(0.0, 2.0, 100) for i in range(1000)}
    errors["better"] = lifts + 7.0 + rng.normal(0.0, 2.0, 100)
    errors["worse"] = lifts + 13.0 + rng.normal(0.0, 2.0, 100)
    groups = rank_groups(errors)
    assert groups[0] == ("better",)
    assert groups[-1] == ("worse",)
    assert sum(map(len, groups)) == 1002
    assert len(groups) <= 4
