"""Copies of a lift under other names are refused, however they were changed; like lifts are not."""

import numpy as np
import pytest
from colift.agents.humans import load_recordings
from colift.base.errors import InputError

from .motion import lift, rows, table

TIMES, HEIGHTS = lift()


def refused(tmp_path, times, heights):
    """Return the message if the lift and another series are refused as one, else nothing."""
    path = tmp_path / "lifts.csv"
    path.write_text(table(rows(TIMES, HEIGHTS), rows(times, heights, trial="b")))
    try:
        load_recordings(path)
    except InputError as error:
        return str(error)
    return ""


@pytest.mark.parametrize(
    ("times", "heights"),
    [
        (TIMES, HEIGHTS),
        (TIMES + 1000.0, HEIGHTS),
        (TIMES, HEIGHTS + 0.4),
        (TIMES, 0.3 * HEIGHTS),
        (TIMES, 2.0 - HEIGHTS),
        (TIMES, np.round(HEIGHTS, 3)),
        (TIMES[::2], HEIGHTS[::2]),
        (TIMES / 1.5, HEIGHTS),
    ],
    ids=["equal", "later", "higher", "scaled", "inverted", "rounded", "half the rate", "faster"],
)
def test_a_copy_is_refused(tmp_path, times, heights):
    told = refused(tmp_path, times, heights)
    assert "line 602: trial 'b' is the same lift as 'a': keep one of them" in told


@pytest.mark.parametrize(
    ("times", "heights"),
    [
        (TIMES, HEIGHTS + 0.01 * np.sin(TIMES)),
        (TIMES[20:], HEIGHTS[20:]),
        lift(duration=7.0),
    ],
    ids=["another movement", "a later start", "a longer rest"],
)
def test_another_lift_is_read(tmp_path, times, heights):
    assert refused(tmp_path, times, heights) == ""


def test_the_first_of_many_copies_is_named(tmp_path):
    others = [rows(*lift(top=0.05 + 0.05 * k), trial=f"other{k}") for k in range(3)]
    path = tmp_path / "lifts.csv"
    copies = [rows(TIMES, HEIGHTS, trial=f"copy{k}") for k in range(8)]
    path.write_text(table(*others, *copies))
    with pytest.raises(InputError, match="'copy1' is the same lift as 'copy0'"):
        load_recordings(path)
