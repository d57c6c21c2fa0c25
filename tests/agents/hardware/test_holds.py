"""How holds add up."""

import pytest
from colift.agents.hardware.holds import Holds


def held(pattern, period=0.1):
    """Return for how long the hands were held, at each step."""
    holds = Holds()
    return [holds.step(period * k, held=each) for k, each in enumerate(pattern)]


def test_a_hold_counts_until_the_next_step():
    assert held([False, True, True, False, False]) == pytest.approx([0, 0, 0.1, 0.2, 0.2])


def test_bursts_add_up_and_are_forgotten_after_five_seconds():
    times = held([*[True] * 4, *[False] * 46, *[True] * 4, *[False] * 6])
    assert times[49] == pytest.approx(0.4)
    assert times[56] == pytest.approx(0.4)
    assert max(held(([True] * 2 + [False] * 8) * 10)) == pytest.approx(1.0)
    assert max(held(([True] * 3 + [False] * 7) * 10)) == pytest.approx(1.5)


def test_periods_that_were_skipped_count_as_what_the_step_before_them_was():
    holds = Holds()
    holds.step(0.0, held=True)
    assert holds.step(0.7, held=True) == pytest.approx(0.7)
