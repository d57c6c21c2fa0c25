"""What intervals and ranks promise, with people drawn anew."""

import dataclasses

import numpy as np
import pytest
from colift.benchmark.statistics import simulation
from colift.benchmark.statistics.population import ErrorModel
from colift.benchmark.statistics.simulation import (
    BOARDS,
    SAMPLES,
    TOUCH,
    Sample,
    coverage,
    false_splits,
)

MODEL = ErrorModel(behaviours_mm=(5.0, 20.0), person=0.4, suiting=0.2, lift=0.3, rest=0.2)


def test_drawn_errors_have_the_mean_and_the_spread_of_the_model() -> None:
    scales = np.array([1.0, 2.0])
    errors = MODEL.draw(scales, 40_000, np.random.default_rng(0))
    assert errors.mean(axis=1) == pytest.approx(MODEL.mean_mm * scales, rel=0.02)
    logs = np.log(errors).reshape(2, -1, 2)
    parts = (MODEL.person, MODEL.suiting, MODEL.lift, MODEL.rest)
    assert logs.var(axis=1) == pytest.approx(sum(part**2 for part in parts), rel=0.03)
    first, second = logs[0].T
    shared = MODEL.person**2 + MODEL.suiting**2
    assert np.cov(first, second)[0, 1] == pytest.approx(shared, rel=0.05)


@pytest.mark.parametrize("sample", SAMPLES, ids=lambda each: each.name)
def test_intervals_contain_the_true_value_in_92_percent_or_more(sample: Sample) -> None:
    """400 suites leave a standard error of 1.1 %."""
    found = list(coverage(sample, 400))
    assert {each.quantity for each in found} == {"RMSE", "difference", "vs_human", "gap"}
    assert all(0.90 <= each.share <= 0.99 for each in found), found


def test_the_count_notices_intervals_that_take_lifts_for_people(monkeypatch) -> None:
    sample = Sample(name="", model=dataclasses.replace(TOUCH, person=0.6), people=25)
    lifts = simulation.ErrorModel.units(TOUCH, 25).episodes(["all"] * 100)
    monkeypatch.setattr(ErrorModel, "units", lambda model, people: lifts)
    (rmse, *_) = coverage(sample, 200)
    assert rmse.share < 0.85
    assert not rmse.holds


def test_equal_policies_are_told_apart_on_few_boards() -> None:
    """Of 60 boards, 6 % are 3.6; nine or more have a probability of 1 %."""
    for board in BOARDS:
        found = false_splits(board, SAMPLES[0], 60)
        assert found.share <= 8 / 60, found
