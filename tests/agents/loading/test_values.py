import math
from typing import Literal, Optional

import numpy as np
import pytest
from colift.agents.loading.values import kind, read_value, readable, write_value

Reading = Literal["variance as rho", "standard deviation as rho"]


@pytest.mark.parametrize(
    ("hint", "text", "value"),
    [
        (float, "0.9", 0.9),
        (float, "-1e5", -1e5),
        (float, "3", 3.0),
        (float, "inf", math.inf),
        (int, "-12", -12),
        (bool, "true", True),
        (bool, "False", False),
        (str, "two words", "two words"),
        (float | None, "none", None),
        (float | None, "2", 2.0),
        (Optional[int], "None", None),  # noqa: UP045
        (Reading, "variance as rho", "variance as rho"),
        (Reading, "standard", "standard deviation as rho"),
        (Reading, "STANDARD Deviation", "standard deviation as rho"),
        (Literal["a", "ab"], "a", "a"),
        (Literal[1, 2], "2", 2),
        (tuple[float, ...], "1/2.5/-3", (1.0, 2.5, -3.0)),
        (tuple[float, ...], "4", (4.0,)),
        (tuple[float, ...], "none", ()),
        (tuple[int, int], "1/2", (1, 2)),
    ],
)
def test_reads(hint, text, value):
    assert readable(hint)
    found = read_value(hint, text)
    assert found == value
    assert type(found) is type(value)


@pytest.mark.parametrize(
    ("hint", "text"),
    [
        (float, "fast"),
        (float, "nan"),
        (float, ""),
        (float, "none"),
        (int, "2.5"),
        (int, "true"),
        (bool, "1"),
        (bool, "yes"),
        (str, ""),
        (Reading, "rho"),
        (Reading, ""),
        (Literal["here", "hence"], "he"),
        (tuple[float, ...], "1//2"),
        (tuple[float, ...], "1/nan"),
        (tuple[float, float], "1"),
        (tuple[float, float], "1/2/3"),
        (float | None, "x"),
    ],
)
def test_refuses(hint, text):
    with pytest.raises(ValueError):  # noqa: PT011
        read_value(hint, text)


@pytest.mark.parametrize(
    "hint",
    [list[float], dict, np.ndarray, type(None), int | str, tuple[int, str], tuple, tuple[()], None],
)
def test_other_types_are_not_readable(hint):
    assert not readable(hint)


@pytest.mark.parametrize(
    ("hint", "value", "text"),
    [
        (float, 123000.0, "123000"),
        (float, 0.45, "0.45"),
        (bool, True, "true"),
        (float | None, None, "none"),
        (tuple[float, ...], (), "none"),
        (tuple[float, ...], (0.0, 1.5), "0/1.5"),
        (Reading, "variance as rho", "variance as rho"),
    ],
)
def test_writes_what_it_reads(hint, value, text):
    assert write_value(value) == text
    assert read_value(hint, text) == value


@pytest.mark.parametrize(
    ("hint", "words"),
    [
        (int, "a whole number"),
        (float | None, "a number, or none"),
        (Literal["a", "b"], "one of 'a', 'b'"),
        (tuple[float, ...], "values with / between, each a number"),
        (tuple[int, int], "2 values with / between, each a whole number"),
    ],
)
def test_says_what_would_be_right(hint, words):
    assert kind(hint) == words
