"""All pairs of policies are one family, and ranks follow from it."""

import itertools

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.statistics import Units, all_pairs, decisive, paired_permutation_p

PEOPLE, WAYS = 15, 4
N = PEOPLE * WAYS
LIFTS = np.tile(np.linspace(5.0, 40.0, WAYS), PEOPLE)
UNITS = Units.people((way, person) for person in range(PEOPLE) for way in range(WAYS))


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


def test_clearly_different_policies_have_their_places() -> None:
    assert all_pairs(policies(2.0, 0.0, 4.0), UNITS).ranks == {"b": 1, "a": 2, "c": 3}


def test_a_rank_is_one_more_than_the_number_of_better_policies(board) -> None:
    family, least = all_pairs(board, UNITS), 1
    for name, rank in family.ranks.items():
        better = [
            other
            for other in board
            if family.apart(name, other) and board[other].mean() < board[name].mean()
        ]
        least = max(least, 1 + len(better))
        assert rank == least


def test_ranks_are_in_order_and_the_best_mean_is_first(board) -> None:
    ranks = all_pairs(board, UNITS).ranks
    assert list(ranks.values()) == sorted(ranks.values())
    assert list(ranks) == sorted(board, key=lambda name: board[name].mean())


def test_who_is_ruined_in_some_lifts_does_not_pass_who_is_better() -> None:
    """Nobody can be told from them, since one person decides their mean."""
    errors = policies(0.0, 2.0)
    errors["wild"] = errors["a"] - 0.1 + 400.0 * (np.arange(N) < 2)
    family = all_pairs(errors, UNITS)
    assert not family.apart("a", "wild")
    assert family.ranks == {"a": 1, "b": 2, "wild": 2}


def test_policies_that_cannot_be_told_apart_share_a_rank() -> None:
    assert all_pairs(policies(0.0, 0.05, 5.0), UNITS).ranks == {"a": 1, "b": 1, "c": 3}


def test_identical_policies_are_never_told_apart() -> None:
    errors = policies(0.0, 3.0)
    errors["z"] = errors["b"].copy()
    family = all_pairs(errors, UNITS)
    assert family.p("b", "z") == 1.0
    assert family.ranks == {"a": 1, "b": 2, "z": 2}


def test_the_order_of_the_input_does_not_matter(board) -> None:
    expected = all_pairs(board, UNITS).ranks
    for order in list(itertools.permutations(board))[:: 5040 // 6]:
        assert all_pairs({name: board[name] for name in order}, UNITS).ranks == expected


def test_a_family_asks_for_more_than_a_single_test(board) -> None:
    family = all_pairs(board, UNITS)
    for one, other in itertools.combinations(board, 2):
        alone = paired_permutation_p(board[one], board[other], UNITS)
        assert family.p(one, other) >= alone - 0.005
        assert family.p(one, other) == family.p(other, one)


def test_of_two_policies_the_family_is_the_paired_test() -> None:
    errors = policies(0.0, 0.25)
    alone = paired_permutation_p(errors["a"], errors["b"], UNITS)
    assert all_pairs(errors, UNITS).p("a", "b") == pytest.approx(alone, abs=1e-9)


def test_lifts_with_one_person_are_one_piece_of_evidence() -> None:
    """A policy that suits two of six people is better in a third of the lifts, by chance."""
    people = np.repeat([5.0, 5.0, -1.0, -1.0, -1.0, -1.0], 20)
    units = Units.people((0, person) for person in np.repeat(range(6), 20).tolist())
    errors = {"a": 20.0 + 0.0 * people, "b": 20.0 + people}
    assert not all_pairs(errors, units).apart("a", "b")
    assert all_pairs(errors, Units.episodes(["all"] * 120)).apart("a", "b")


def test_step_down_tells_more_apart_than_one_step_would() -> None:
    """Once the far ones are told apart, the rest are tested among themselves, with fewer pairs."""
    found = [
        (all_pairs(policies(0.0, 0.45, seed=seed), UNITS).p("a", "b"), far.p("a", "b"))
        for seed in range(5)
        for far in [all_pairs(policies(0.0, 0.45, 50.0, seed=seed), UNITS)]
    ]
    assert all(with_far == pytest.approx(alone, abs=0.02) for alone, with_far in found)


def test_one_policy_or_none() -> None:
    assert all_pairs({"a": np.arange(N) + 1.0}, UNITS).ranks == {"a": 1}
    assert all_pairs({}, UNITS).ranks == {}


def test_needs_the_same_episodes() -> None:
    with pytest.raises(InputError, match="pairs are needed"):
        all_pairs({"a": [1.0, 2.0], "b": [1.0]}, UNITS)


@pytest.mark.parametrize("people", range(1, 11))
def test_what_is_decisive_can_be_told_apart_and_nothing_else(people: int) -> None:
    """However clear the differences are: the number of people decides."""
    units = Units.people((0, person) for person in range(people))
    errors = {f"p{k}": np.full(people, 1.0 + 100.0 * k) for k in range(4)}
    assert decisive(people) == all_pairs(errors, units).apart("p0", "p1")


def test_of_a_thousand_policies_those_that_can_be_told_apart_are() -> None:
    """A cluster of equals, one that is better and one that is worse than all of them."""
    rng = np.random.default_rng(0)
    units = Units.people((way, person) for person in range(75) for way in range(4))
    lifts = rng.gamma(2.0, 5.0, 300)
    errors = {f"p{i}": lifts + 10.0 + rng.normal(0.0, 2.0, 300) for i in range(1000)}
    errors["better"] = lifts + 8.0 + rng.normal(0.0, 2.0, 300)
    errors["worse"] = lifts + 12.0 + rng.normal(0.0, 2.0, 300)
    ranks = all_pairs(errors, units).ranks
    assert ranks.pop("better") == 1
    assert ranks.pop("worse") == 1002
    assert set(ranks.values()) == {2}


@pytest.mark.parametrize("seed", range(4))
def test_what_is_not_flipped_because_it_is_far_away_would_have_been_told_apart(
    seed: int, monkeypatch
) -> None:
    rng = np.random.default_rng(seed)
    difficulty = rng.gamma(2.0, 5.0, N)
    errors = {
        f"p{i}": difficulty + mean + rng.normal(0.0, 3.0, N) + 100.0 * (rng.random(N) < 0.02)
        for i, mean in enumerate(rng.uniform(0.0, 40.0, 12))
    }
    quick = all_pairs(errors, UNITS)
    monkeypatch.setattr("colift.benchmark.statistics.ranking.far_apart", lambda p: np.inf)
    whole = all_pairs(errors, UNITS)
    assert quick.ranks == whole.ranks
