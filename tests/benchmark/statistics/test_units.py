"""People stay together with all of their lifts, and nobody alone counts as certain."""

import math

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.statistics import Units, mean_of


def crossed(people: int, ways: int = 4) -> Units:
    return Units.people((way, person) for person in range(people) for way in range(ways))


def nested(people: int, ways: int = 4, lifts: int = 2) -> Units:
    """Return people with a behaviour of their own, some lifts each."""
    return Units.people(
        (way, (way, person))
        for way in range(ways)
        for person in range(people)
        for _ in range(lifts)
    )


def test_people_in_all_behaviours_are_one_group() -> None:
    units = crossed(25)
    assert (units.count, units.freedom) == (25, 24)
    assert units.sizes.tolist() == [4.0] * 25


def test_people_with_a_behaviour_of_their_own_are_a_group_for_each_behaviour() -> None:
    units = nested(5)
    assert (units.count, units.freedom) == (20, 16)


def test_the_standard_error_is_that_of_the_means_of_people() -> None:
    rng = np.random.default_rng(0)
    values = rng.normal(size=(25, 1)) + 0.1 * rng.normal(size=(25, 4))
    means = values.mean(axis=1)
    expected = means.std(ddof=1) / math.sqrt(25)
    assert crossed(25).standard_error(values.ravel()) == pytest.approx(expected)


def test_lifts_of_one_person_say_less_than_lifts_of_many() -> None:
    """Four lifts with each of 25 people are no sample of a hundred."""
    rng = np.random.default_rng(1)
    values = np.repeat(rng.normal(size=25), 4)
    alone = Units.episodes(["all"] * 100).standard_error(values)
    people = crossed(25).standard_error(values)
    assert alone is not None
    assert people is not None
    assert people == pytest.approx(2.0 * alone, rel=0.05)


def test_differences_between_groups_add_nothing_to_the_error() -> None:
    rng = np.random.default_rng(2)
    values = rng.normal(size=(4, 5, 2))
    plain = nested(5).standard_error(values.ravel())
    apart = nested(5).standard_error((values + 100.0 * np.arange(4)[:, None, None]).ravel())
    assert apart == pytest.approx(plain)


def test_a_person_alone_in_a_group_is_joined_with_others() -> None:
    four_alone = Units.people([("a", 1), ("b", 2), ("c", 3), ("d", 4)])
    assert (four_alone.count, four_alone.freedom) == (4, 3)
    one_alone = Units.people([("a", 1), ("a", 2), ("a", 3), ("b", 4), ("b", 5), ("c", 6)])
    assert one_alone.freedom == 6 - 2
    assert one_alone.group[5] == one_alone.group[4]


def test_a_single_person_gives_no_error_and_no_interval() -> None:
    one = Units.people([("a", 1), ("b", 1), ("c", 1)])
    assert one.standard_error(np.array([1.0, 2.0, 4.0])) is None
    assert mean_of([1.0, 2.0, 4.0], one).ci95 is None


def test_a_part_keeps_its_people_and_groups() -> None:
    """Where some lifts have no value, the rest of the people are still one group."""
    kept = [i for i in range(40) if i not in (0, 5, 6, 7, 8, 9)]
    part = crossed(10).select(kept)
    assert (part.count, part.freedom) == (10, 9)
    assert part.sizes.sum() == len(kept)
    without = crossed(10).select(range(4, 40))
    assert without.count == 9


def test_the_order_of_the_lifts_does_not_matter() -> None:
    rng = np.random.default_rng(3)
    labels = [(way, person) for person in range(6) for way in range(3)]
    values = rng.normal(size=18)
    order = rng.permutation(18)
    shuffled = Units.people([labels[i] for i in order])
    assert shuffled.standard_error(values[order]) == pytest.approx(
        Units.people(labels).standard_error(values)
    )


def test_needs_a_person_for_each_value() -> None:
    with pytest.raises(InputError, match="units of 8 episodes for 3 values"):
        mean_of([1.0, 2.0, 3.0], crossed(2))
