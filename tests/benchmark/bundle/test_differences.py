"""Where two contents differ, to the bit."""

import math

import pytest
from colift.benchmark.bundle import differences
from hypothesis import given
from hypothesis import strategies as st

json_like = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=True) | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner),
    max_leaves=8,
)


@given(json_like)
def test_a_content_differs_from_itself_nowhere(content):
    assert not [*differences(content, content)]


@given(json_like, json_like)
def test_no_difference_means_equal_texts(one, other):
    assert bool([*differences(one, other)]) == (canonical(one) != canonical(other))


def canonical(content):
    if isinstance(content, dict):
        return {name: canonical(value) for name, value in content.items()}
    if isinstance(content, list):
        return [canonical(value) for value in content]
    return repr(content)


@pytest.mark.parametrize(
    ("claimed", "true", "told"),
    [
        ({"a": {"b": 1.0}}, {"a": {"b": math.nextafter(1.0, 2)}}, "a.b says 1.0, should be 1.000"),
        ({"a": [{"b": 1}]}, {"a": [{"b": 2}]}, "a[0].b says 1, should be 2"),
        ({"a": 0.0}, {"a": -0.0}, "a says 0.0, should be -0.0"),
        ({"a": 1}, {"a": 1.0}, "a says 1, should be 1.0"),
        ({"a": True}, {"a": 1}, "a says True, should be 1"),
        ({}, {"a": None}, "a says nothing, should be None"),
        ({"a": None}, {}, "a says None, should be nothing"),
        ({"a": [1]}, {"a": [1, 2]}, "a.length says 1, should be 2"),
        ({"a": math.nan}, {"a": 1.0}, "a says nan, should be 1.0"),
    ],
)
def test_the_place_and_both_values_are_told(claimed, true, told):
    (difference,) = differences(claimed, true)
    assert str(difference).startswith(told)


def test_a_tolerance_is_for_numbers_alone():
    assert not [*differences({"a": 1.0}, {"a": 1.0005}, tolerance=1e-3)]
    assert [*differences({"a": 1.0}, {"a": 1.002}, tolerance=1e-3)]
    assert [*differences({"a": 1}, {"a": 2}, tolerance=10.0)]
    assert [*differences({"a": math.nan}, {"a": 2.0}, tolerance=10.0)]
    assert not [*differences({"a": math.nan}, {"a": math.nan}, tolerance=10.0)]
