"""Fluctuation and settling on courses made by hand."""

import math

import numpy as np
import pytest
from colift.benchmark.paper.topics.forgetting import fluctuation, settling_steps
from colift.benchmark.paper.watched import rms


def test_rms_of_three_and_four_leaves_out_what_is_missing():
    assert rms([3.0, math.nan, 4.0]) == pytest.approx(math.sqrt(12.5))


def test_a_course_that_stands_still_does_not_fluctuate():
    assert fluctuation([0.4] * 9) == 0.0


def test_fluctuation_is_the_rms_step_whatever_its_direction():
    assert fluctuation([0.0, 0.3, 0.0, 0.3]) == pytest.approx(0.3)
    assert fluctuation([0.0, 0.3, 0.3, 0.7]) == pytest.approx(math.sqrt((0.09 + 0.16) / 3))


def test_a_course_at_rest_has_settled_at_once():
    assert settling_steps([0.8] * 12) == 0
    assert settling_steps([0.8] * 12, staying=True) == 0


def test_settling_counts_the_steps_until_within_five_percent():
    course = [0.0, 0.5, 0.9, 0.96] + [1.0] * 12
    assert settling_steps(course) == 3


def test_an_exponential_settles_after_three_time_constants():
    course = 1 - np.exp(-np.arange(200) / 10)
    assert settling_steps(course) == math.ceil(10 * math.log(20))


def test_a_later_departure_counts_only_for_staying():
    course = [0.0, 1.0, 1.0, 0.8, 1.0, 1.0, 1.0, 1.0]
    assert settling_steps(course) == 1
    assert settling_steps(course, staying=True) == 4
