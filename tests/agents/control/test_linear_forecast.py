"""A linear forecast reads what it wrote, is exact where it must be, and refuses nonsense."""

import json

import numpy as np
import pytest
from colift.agents.control.linear_forecast import (
    TAPS,
    LinearForecast,
    linear_json,
    load_linear,
    read_linear,
)
from colift.base.errors import InputError

HORIZONS = np.array([0.1, 0.2])


def line():
    """Return the forecast of a straight line through the last two samples."""
    weights = np.zeros((2, TAPS - 1))
    weights[:, 0] = (1.0, 2.0)
    return LinearForecast(interval=0.1, horizons=HORIZONS, weights=weights)


def test_its_rise_is_linear_between_the_horizons_and_zero_now():
    changes = np.array([0.01, *[0.5] * (TAPS - 2)])
    found = [line().rise(changes, horizon) for horizon in (0.0, 0.05, 0.1, 0.15, 0.2, 0.9)]
    assert found == pytest.approx([0.0, 0.005, 0.01, 0.015, 0.02, 0.02])


def test_a_file_gives_the_forecast_that_was_written():
    again = read_linear(linear_json(line()))
    assert (again.weights == line().weights).all()
    assert (again.horizons == HORIZONS).all()
    assert again.interval == 0.1


def test_the_shipped_one_names_its_command_and_the_people_it_is_from():
    shipped = load_linear().provenance
    assert shipped["command"].startswith("colift learn linear --lifts ")
    first, last = shipped["seeds"]
    assert 100_000 <= first < last < 200_000
    assert "unsettled" in shipped["behaviours"]


@pytest.mark.parametrize(
    ("part", "value", "message"),
    [
        ("weights", [[0.0] * (TAPS - 1)], "2 horizons need finite weights of the shape"),
        ("weights", [[float("nan")] * (TAPS - 1)] * 2, "need finite weights"),
        ("horizons_s", [0.2, 0.1], r"horizons must be positive and increase, got \[0.2, 0.1\]"),
        ("horizons_s", [0.0, 0.1], "horizons must be positive and increase"),
        ("interval_s", 0.0, "interval must be a positive time, got 0.0"),
        ("interval_s", "soon", "not a linear forecast: ValueError"),
    ],
)
def test_numbers_that_make_no_sense_are_refused(part, value, message):
    content = json.loads(linear_json(line())) | {part: value}
    with pytest.raises(InputError, match=message):
        read_linear(json.dumps(content))
