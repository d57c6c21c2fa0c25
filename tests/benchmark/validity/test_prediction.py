import numpy as np
import pytest
from colift.benchmark.validity.prediction import predict
from colift.benchmark.validity.scores import RESAMPLES

from .conftest import MEANS, scores


def test_the_same_order_and_size_are_predicted(suite):
    found = predict(scores(MEANS, name="people", seed=2), suite)
    assert (found.spearman.value, found.kendall.value) == (1.0, 1.0)
    assert found.kendall_best_half.value == 1.0
    assert found.factor.value == pytest.approx(1.0, abs=0.002)
    assert found.bias.low < 1.0 < found.bias.high
    assert (found.fall_behind, found.overtake) == ((), ())


def test_the_size_is_relative_to_two_people_on_the_same_lifts(suite):
    twice = {policy: 2.0 * mean for policy, mean in MEANS.items()}
    harder = predict(scores(twice, human_human=16.0, seed=2), suite)
    assert harder.factor.value == pytest.approx(1.0, abs=0.002)
    worse = predict(scores(twice, seed=2), suite)
    assert worse.factor.value == worse.bias.value == pytest.approx(2.0, abs=0.01)
    assert worse.bias.low > 1.8
    better = predict(scores({p: 0.5 * m for p, m in MEANS.items()}, seed=2), suite)
    assert better.factor.value == pytest.approx(2.0, abs=0.02)
    assert better.bias.value == pytest.approx(0.5, abs=0.005)


def test_the_reverse_order_is_no_prediction(suite):
    turned = dict(zip(MEANS, reversed(MEANS.values()), strict=True))
    found = predict(scores(turned, seed=2), suite)
    assert found.spearman.value == pytest.approx(-1.0)
    assert found.spearman.high < 0.0
    assert found.kendall.value == pytest.approx(-1.0)


def test_poor_policies_do_not_hide_a_wrong_order_of_the_better_half(suite):
    turned = MEANS | {"a": 7.0, "c": 4.0}
    found = predict(scores(turned, seed=2), suite)
    assert found.spearman.value > 0.7
    assert found.kendall_best_half.value == pytest.approx(-1.0)


def test_the_order_of_those_that_beat_two_people_has_numbers_of_its_own(suite):
    turned = MEANS | {"a": 7.0, "c": 4.0}
    better = predict(scores(turned, seed=2), suite).better
    assert better.policies == ("a", "b", "c")
    assert (better.spearman.value, better.kendall.value) == (-1.0, -1.0)
    assert predict(suite, scores(MEANS, human_human=6.0)).better is None


def test_policies_beyond_two_people_on_one_side_only_are_named(suite):
    moved = MEANS | {"b": 12.0, "c": 8.02, "e": 6.0}
    found = predict(scores(moved, seed=2), suite)
    assert (found.fall_behind, found.overtake) == (("b",), ("e",))


def test_fewer_lifts_give_wider_intervals_around_the_same_number(suite):
    means = {"a": 4.0, "b": 4.2, "c": 4.4, "d": 4.6, "e": 4.8, "f": 5.0}
    widths = []
    for lifts in (4, 16, 64):
        found = predict(scores(means, lifts=lifts, spread=0.8, seed=2), suite)
        assert found.spearman.value == pytest.approx(1.0)
        assert found.spearman.high == pytest.approx(1.0)
        widths.append(found.spearman.high - found.spearman.low)
    assert widths[0] > widths[1] > widths[2] > 0.0


def test_a_suite_of_few_lifts_widens_the_interval_too():
    close = {"a": 4.0, "b": 4.1, "c": 4.2, "d": 4.3}
    source = scores(close, name="people", lifts=200, spread=0.3, seed=2)
    few, many = (scores(close, lifts=lifts, spread=0.3) for lifts in (6, 200))
    assert predict(source, few).kendall.low < predict(source, many).kendall.low


def test_the_resamples_take_the_same_lifts_for_all_policies():
    difficulty = np.random.default_rng(0).normal(0.0, 3.0, 30)
    source = scores(MEANS, lifts=30, spread=0.0, seed=2)
    hard = {name: errors + difficulty for name, errors in source.errors.items()}
    object.__setattr__(source, "errors", hard)
    spread = source.resampled - source.resampled[:, :1]
    assert source.resampled.shape == (RESAMPLES, len(MEANS))
    assert spread.std(axis=0) == pytest.approx(np.zeros(len(MEANS)), abs=1e-12)
    assert source.resampled[:, 0].std() > 0.3


def test_the_same_scores_give_the_same_prediction(suite):
    first, second = (predict(scores(MEANS, lifts=5, seed=2), suite) for _ in range(2))
    assert first == second
