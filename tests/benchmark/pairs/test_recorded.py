"""The pairs of a file, and the simulated two people on their movements."""

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.pairs.coordination import coordination
from colift.benchmark.pairs.recorded import recorded_pairs
from colift.benchmark.pairs.simulated import movements, simulated_pairs
from colift.benchmark.pairs.summary import summarise_pairs
from colift.benchmark.statistics import Units, mean_of

from .synthetic import pair, write

LAGS = (0.05, 0.06, 0.08, 0.07)


def lifts(people="AABB", **more):
    """Return four lifts of different movements and lags."""
    return [
        (f"lift{i}", person, pair(100.0, lag=lag, top=0.16 + 0.02 * i, first=0.6 + 0.3 * i, **more))
        for i, (person, lag) in enumerate(zip(people, LAGS, strict=True))
    ]


@pytest.fixture
def path(tmp_path):
    return tmp_path / "pairs.csv"


def summary_of(path):
    found = recorded_pairs(path)
    real = movements(found.lifts, path.name)
    return summarise_pairs(found, path.name, simulated_pairs(found.lifts, real))


def test_a_file_has_the_lags_that_were_put_in(path):
    found = recorded_pairs(write(path, lifts(gain=1.05, noise=0.0005)))
    measures = [coordination(lift.ends) for lift in found.lifts]
    assert [each.lag_ms for each in measures] == pytest.approx([1000 * x for x in LAGS], abs=2.0)
    assert [each.gain for each in measures] == pytest.approx([1.05] * 4, abs=0.003)
    assert [lift.pair for lift in found.lifts] == [*"AABB"]


def test_an_inclination_and_a_length_are_as_good_as_heights(path, tmp_path):
    inclined = [
        (trial, person, (times, near, np.degrees(np.arcsin((near - far) / 1.5))))
        for trial, person, (times, near, far) in lifts(difference=0.02)
    ]
    write(path, inclined, ("tilt_deg",))
    with pytest.raises(InputError, match=r"'lift0' has tilt_deg but no z_far_m: .*--length METRES"):
        recorded_pairs(path)
    by_tilt = [coordination(each.ends) for each in recorded_pairs(path, 1.5).lifts]
    heights = recorded_pairs(write(tmp_path / "heights.csv", lifts(difference=0.02)), 1.5)
    for one, other in zip(
        by_tilt, (coordination(each.ends) for each in heights.lifts), strict=True
    ):
        assert one.rmse_mm == pytest.approx(other.rmse_mm, abs=0.01)
        assert one.lag_ms == pytest.approx(other.lag_ms, abs=0.1)
        assert one.mean_tilt_deg == pytest.approx(other.mean_tilt_deg, abs=0.02)


def test_heights_and_inclinations_must_be_those_of_the_length(path):
    both = [
        (trial, person, (times, near, far, np.degrees(np.arcsin((near - far) / 1.5))))
        for trial, person, (times, near, far) in lifts(difference=0.02)
    ]
    write(path, both, ("z_far_m", "tilt_deg"))
    assert len(recorded_pairs(path, 1.5).lifts) == len(recorded_pairs(path).lifts) == 4
    with pytest.raises(
        InputError, match=r"'lift0' is of no table of --length 3: .*no table of 3 m"
    ):
        recorded_pairs(path, 3.0)


def test_a_file_without_a_far_end_is_refused_with_the_columns_to_add(path):
    write(path, [(name, who, series[:2]) for name, who, series in lifts()], ())
    with pytest.raises(InputError, match=r"no trial has the other end .* z_far_m, .* or tilt_deg"):
        recorded_pairs(path)


def test_a_similar_column_is_named(path):
    write(path, lifts(), ("Z_far",))
    with pytest.raises(InputError, match=r"rename one of 'Z_far'\?"):
        recorded_pairs(path)


@pytest.mark.parametrize("length", [0.0, 80.0, -1.0, float("nan")])
def test_a_length_that_no_table_has_is_refused(path, length):
    with pytest.raises(InputError, match=r"table's length is .* must be from 0.2 to 5 m"):
        recorded_pairs(write(path, lifts()), length)


def test_the_simulated_two_people_move_as_recorded_and_are_measured_alike(path):
    summary = summary_of(write(path, lifts()))
    assert [*summary.simulated.lifts] == [*summary.lifts]
    for found in summary.simulated.lifts.values():
        assert 20.0 < found.lag_ms < 120.0
        assert 0.9 < found.gain < 1.1
        assert abs(found.mean_difference_mm) < 2.0
    rmse = summary.averages["rmse_mm"]
    assert rmse.difference.mean == pytest.approx(rmse.recorded.mean - rmse.simulated.mean)


def test_intervals_over_lifts_and_over_pairs_are_of_different_people(path):
    summary = summary_of(write(path, lifts()))
    lag = summary.averages["lag_ms"]
    values = [each.lag_ms for each in summary.lifts.values()]
    assert lag.recorded == mean_of(values, Units.episodes("AABB"))
    assert lag.over_pairs == mean_of(values, Units.people(("", who) for who in "AABB"))
    width = lag.over_pairs.ci95[1] - lag.over_pairs.ci95[0]
    assert width > 3 * (lag.recorded.ci95[1] - lag.recorded.ci95[0])
    assert summary.people == 2


@pytest.mark.parametrize("people", ["AAAA", ["", "", "", ""], ["A", "A", "B", ""]])
def test_without_two_named_pairs_there_is_no_interval_over_pairs(path, people):
    summary = summary_of(write(path, lifts(people)))
    assert summary.averages["rmse_mm"].over_pairs is None
    assert summary.averages["rmse_mm"].recorded.ci95 is not None
    assert summary.people == (people == "AAAA")


def test_lifts_that_no_simulated_hand_can_reach_are_measured_and_not_simulated(path):
    high = [("high", "A", pair(100.0, lag=0.05, top=0.6))]
    high.append(("low", "A", pair(100.0, lag=0.05, top=0.2, first=2.0)))
    summary = summary_of(write(path, high))
    assert [*summary.lifts] == ["high", "low"]
    assert [*summary.simulated.lifts] == ["low"]
    assert "must be within -0.2 to 0.5 m" in summary.simulated.left_out["high"]
    assert summary_of(write(path, high[:1])).averages["rmse_mm"].simulated is None
