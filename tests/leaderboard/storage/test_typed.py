"""Types of records, compared with their declarations."""

import dataclasses
from collections.abc import Mapping
from typing import Any, Literal

import pytest
from colift.leaderboard.storage.typed import mistyped

from ..rows import make_row


@dataclasses.dataclass(frozen=True)
class Inner:
    at: float
    ends: tuple[float, float]


@dataclasses.dataclass(frozen=True)
class Outer:
    name: str
    inner: Inner | None
    counts: Mapping[str, int]
    words: tuple[str, ...]
    kind: Literal["a", "b"]
    more: Any
    flag: bool | None


GOOD = Outer("x", Inner(1, (0.5, 2)), {"a": 1}, ("u", "v"), "a", object(), None)


def test_what_is_as_declared_has_no_fault():
    assert mistyped(GOOD, Outer, "it") is None
    assert mistyped(dataclasses.replace(GOOD, inner=None, flag=True), Outer, "it") is None
    row = make_row()
    assert mistyped(row, type(row), "row") is None


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"name": None}, "it.name cannot be None"),
        ({"name": b"x"}, "it.name cannot be b'x'"),
        ({"inner": Inner("x", (0, 1))}, "it.inner.at cannot be 'x'"),
        ({"inner": Inner(True, (0, 1))}, "it.inner.at cannot be True"),
        ({"inner": Inner(float("nan"), (0, 1))}, "it.inner.at cannot be nan"),
        ({"inner": Inner(1, (0,))}, "it.inner.ends cannot be (0,)"),
        ({"inner": Inner(1, (0, None))}, "it.inner.ends[1] cannot be None"),
        ({"inner": []}, "it.inner cannot be []"),
        ({"counts": {"a": True}}, "it.counts.a cannot be True"),
        ({"counts": {1: 1}}, "a key of it.counts cannot be 1"),
        ({"counts": []}, "it.counts cannot be []"),
        ({"words": ("u", 1)}, "it.words[1] cannot be 1"),
        ({"kind": "c"}, "it.kind cannot be 'c'"),
        ({"kind": []}, "it.kind cannot be []"),
        ({"flag": 1}, "it.flag cannot be 1"),
        ({"name": 9 * "\n"}, None),
        ({"name": {}}, "it.name cannot be {}"),
    ],
)
def test_the_first_value_of_another_type_is_named(change, told):
    assert mistyped(dataclasses.replace(GOOD, **change), Outer, "it") == told
