"""Records from JSON: equal to what was written, or refused with the place and the right type."""

import dataclasses
import json
import re
from datetime import UTC, datetime

import msgspec
import pytest
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.records.season import BoardEntry

from ..rows import digest, make_row

ROW = make_row()
ENTRY = BoardEntry(
    season="1",
    submission=digest("mine"),
    name="mine",
    submitter="Ada",
    at=datetime(2026, 11, 20, 8, 30, tzinfo=UTC),
    row=ROW,
    refusal=None,
)


def written(record):
    return json.loads(json.dumps(record.plain()))


def test_a_row_and_an_entry_are_read_as_they_were_written():
    assert BoardRow.read(written(ROW)) == ROW
    refused = dataclasses.replace(ENTRY, row=None, refusal="it cheats")
    assert BoardEntry.read(written(ENTRY)) == ENTRY
    assert BoardEntry.read(written(refused)) == refused


@pytest.mark.parametrize(
    ("place", "value", "told"),
    [
        ("name", None, "Expected `str`, got `null` - at `$.name`"),
        ("authors", ["Ada", 1], "Expected `str`, got `int` - at `$.authors[1]`"),
        ("verified", 1, "Expected `bool`, got `int` - at `$.verified`"),
        ("public.episodes", 1.5, "Expected `int`, got `float` - at `$.public.episodes`"),
        ("public.episodes", True, "Expected `int`, got `bool` - at `$.public.episodes`"),
        ("public.rmse_mm", [], "Expected `object`, got `array` - at `$.public.rmse_mm`"),
        ("public.rmse_mm.mean", "x", "Expected `float`, got `str` - at `$.public.rmse_mm.mean`"),
        ("public.rmse_mm.ci95", [1.0], "length 2, got 1 - at `$.public.rmse_mm.ci95`"),
        ("public.metrics.sparc", 1.0, "Expected `object`, got `float` - at `$.public.metrics"),
        ("hidden.failures", {"step": "2"}, "Expected `int`, got `str` - at `$.hidden.failures"),
        ("hidden.real_time", "yes", "Expected `bool | null`, got `str` - at `$.hidden.real_time`"),
    ],
)
def test_a_value_of_another_type_is_refused(place, value, told):
    content = part = written(ROW)
    *path, last = place.split(".")
    for name in path:
        part = part[name]
    part[last] = value
    with pytest.raises(msgspec.ValidationError, match=re.escape(told)):
        BoardRow.read(content)
    with pytest.raises(msgspec.ValidationError, match=re.escape(told)):
        BoardEntry.read({**written(ENTRY), "row": content})


def test_a_missing_part_is_named():
    content = written(ROW)
    del content["hidden"]["vs_human"]
    with pytest.raises(msgspec.ValidationError, match=r"`vs_human` - at `\$.hidden`"):
        BoardRow.read(content)
