import math

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.statistics import Units, paired_difference, probability_better, share_better

RNG = np.random.default_rng(0)
DIFFICULTY = np.repeat(np.linspace(5.0, 40.0, 75), 4)
UNITS = Units.people((way, person) for person in range(75) for way in range(4))


def pair(difference: float, rng: np.random.Generator = RNG) -> tuple[np.ndarray, np.ndarray]:
    """Return errors of two policies on lifts of different difficulty; differences of sd 2."""
    b = DIFFICULTY + rng.normal(0.0, 1.0, 300)
    return b + difference + rng.normal(0.0, 2.0, 300), b


class TestProbabilityBetter:
    def test_of_normal_differences_is_that_of_the_t_distribution(self) -> None:
        """Of t = -1 with 74 degrees of freedom: 0.8397."""
        people = np.random.default_rng(1).normal(0.0, 2.0, 75)
        people -= people.mean() + people.std(ddof=1) / math.sqrt(75)
        a = DIFFICULTY + np.repeat(people, 4)
        assert probability_better(a, DIFFICULTY, UNITS) == pytest.approx(0.8397, abs=1e-4)

    def test_is_uniform_when_both_are_equally_good_even_with_three_people(self) -> None:
        rng = np.random.default_rng(2)
        units = Units.people((way, person) for person in range(3) for way in range(4))
        found = np.array(
            [
                probability_better(rng.normal(size=12), rng.normal(size=12), units)
                for _ in range(2000)
            ]
        )
        for level in (0.025, 0.1, 0.25, 0.5, 0.75, 0.9, 0.975):
            tolerance = 4 * math.sqrt(level * (1 - level) / len(found))
            assert np.mean(found < level) == pytest.approx(level, abs=tolerance)

    @pytest.mark.parametrize("seed", range(30))
    def test_agrees_with_the_interval_of_the_difference(self, seed: int) -> None:
        a, b = pair(-0.25, np.random.default_rng(seed))
        sure = probability_better(a, b, UNITS) > 0.975
        assert sure == (paired_difference(a, b, UNITS).ci95[1] < 0.0)

    def test_of_the_reverse_is_the_complement(self) -> None:
        a, b = pair(0.1)
        forth, back = probability_better(a, b, UNITS), probability_better(b, a, UNITS)
        assert forth + back == pytest.approx(1.0)

    def test_of_equal_policies_is_one_half(self) -> None:
        assert probability_better(DIFFICULTY, DIFFICULTY, UNITS) == 0.5

    def test_with_one_person_it_is_not_known(self) -> None:
        assert probability_better([1.0, 2.0], [3.0, 4.0], Units.people([(0, 0), (1, 0)])) is None

    def test_needs_pairs(self) -> None:
        with pytest.raises(InputError, match="pairs are needed"):
            probability_better([1.0, 2.0], [1.0], UNITS)


class TestShareBetter:
    def test_counts_the_lifts_and_half_of_the_ties(self) -> None:
        assert share_better([1.0, 2.0, 3.0, 9.0], [2.0, 2.0, 4.0, 1.0]) == 0.625

    def test_does_not_ask_by_how_much(self) -> None:
        assert share_better([1.0, 1.0, 1.0, 900.0], [2.0, 2.0, 2.0, 2.0]) == 0.75

    def test_of_two_normal_errors_is_the_normal_probability(self) -> None:
        """P(N(-1, 1) < N(0, 1)) is Phi(1 / sqrt 2) = 0.7602."""
        rng = np.random.default_rng(3)
        a, b = rng.normal(-1.0, 1.0, 40_000), rng.normal(0.0, 1.0, 40_000)
        assert share_better(a, b) == pytest.approx(0.7602, abs=0.01)

    def test_refuses_a_missing_value(self) -> None:
        with pytest.raises(InputError, match=r"a\[0\] is nan"):
            share_better([math.nan], [1.0])
