"""Who is rougher than two people, and by which metrics."""

import math

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.episode.metric import Metric, metric_table
from colift.benchmark.results.roughness import by_which, rougher
from colift.benchmark.results.scores import ScoreTable

METRICS = metric_table(
    (
        Metric(name="rmse_mm", symbol="RMSE", label="RMSE", meaning="the error"),
        Metric(name="force", symbol="force", label="Force", gentle=True, meaning="the force"),
        Metric(
            name="smooth",
            symbol="smooth",
            label="Smoothness",
            better="more",
            missing="worst",
            gentle=True,
            meaning="the smoothness",
        ),
    )
)
STRATA = tuple(("smooth", f"S{1 + i % 5}") for i in range(40))
NOISE = np.random.default_rng(2).normal(size=(2, 40))


def table(force, smooth, noise=0.0):
    values = {"rmse_mm": [1.0] * 40, "force": (0.3 + force + noise * NOISE[0]).tolist()}
    values["smooth"] = (-2.0 + smooth + noise * NOISE[1]).tolist()
    return ScoreTable(strata=STRATA, values=values, gentle=("force", "smooth"))


PEOPLE = table(0.0, 0.0, noise=0.02)


def test_more_force_and_less_smoothness_are_rougher_beyond_the_interval():
    assert rougher(table(0.1, -0.1), PEOPLE, METRICS) == ("force", "smooth")
    assert rougher(table(0.1, 0.1), PEOPLE, METRICS) == ("force",)
    assert rougher(table(-0.1, 0.1), PEOPLE, METRICS) == ()
    assert rougher(table(0.0, 0.0), PEOPLE, METRICS) == ()


def test_a_difference_within_chance_is_none():
    assert rougher(table(0.01, -0.01, noise=0.2), PEOPLE, METRICS) == ()


def test_lifts_without_a_value_say_nothing():
    nothing = table(-0.1, 0.0)
    nothing.values["smooth"][:] = [math.nan] * 40
    assert rougher(nothing, PEOPLE, METRICS) == ()


def test_it_is_unknown_where_two_people_were_stored_without_these_metrics():
    older = ScoreTable(strata=STRATA, values={"rmse_mm": np.ones(40)})
    assert rougher(table(0.1, 0.0), older, METRICS) is None


def test_a_stored_table_can_be_compared():
    kept = ScoreTable.read(PEOPLE.plain())
    assert rougher(table(0.1, -0.1), kept, METRICS) == ("force", "smooth")
    assert rougher(table(0.1, -0.1), PEOPLE.stored(), METRICS) == ("force", "smooth")


def test_metrics_are_named_in_words():
    assert by_which(("force", "smooth"), METRICS) == "force and smoothness"
    assert by_which(("smooth",), METRICS) == "smoothness"


def test_a_metric_without_a_direction_cannot_tell():
    with pytest.raises(InputError, match=r"'lag' is gentle.*'less' or 'more'"):
        Metric(name="lag", symbol="lag", label="Lag", better="near zero", gentle=True, meaning="")
