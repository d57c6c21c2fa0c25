"""The places at which two contents differ."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final


class _Absent:
    def __repr__(self) -> str:
        return "nothing"


ABSENT: Final = _Absent()
"""A missing value."""


@dataclass(frozen=True, kw_only=True)
class Difference:
    """A value that differs from the correct one."""

    path: str
    """Its place, such as ``groups[2].rmse_mm.mean``."""
    claimed: Any
    """The value found."""
    true: Any
    """The correct value."""

    def __str__(self) -> str:
        return f"{self.path} says {self.claimed!r:.80}, should be {self.true!r:.80}"


def differences(
    claimed: Any, true: Any, *, tolerance: float = 0.0, path: str = ""
) -> Iterator[Difference]:
    """Yield the differences of two JSON-like contents, in the order of the second.

    Parameters
    ----------
    claimed, true
        Dictionaries, lists, texts, numbers, booleans and None; an int never equals a float.
    tolerance
        Allowed relative and absolute difference of floats; 0 demands equal bits.
    path
        The place of both contents, which begins every path.
    """
    if isinstance(claimed, dict) and isinstance(true, dict):
        prefix = f"{path}." if path else ""
        for name in [*true, *(name for name in claimed if name not in true)]:
            where = f"{prefix}{name}"
            if name not in claimed or name not in true:
                yield Difference(
                    path=where, claimed=claimed.get(name, ABSENT), true=true.get(name, ABSENT)
                )
            else:
                yield from differences(claimed[name], true[name], tolerance=tolerance, path=where)
    elif isinstance(claimed, list) and isinstance(true, list):
        if len(claimed) != len(true):
            yield Difference(path=f"{path}.length", claimed=len(claimed), true=len(true))
        else:
            for i, (one, other) in enumerate(zip(claimed, true, strict=True)):
                yield from differences(one, other, tolerance=tolerance, path=f"{path}[{i}]")
    elif not _equal(claimed, true, tolerance):
        yield Difference(path=path, claimed=claimed, true=true)


def _equal(claimed: Any, true: Any, tolerance: float) -> bool:
    if type(claimed) is not type(true):
        return False
    if not isinstance(claimed, float):
        return bool(claimed == true)
    # Numbers without tolerance by their bits: -0.0 is not 0.0. A missing score is NaN.
    if not tolerance or math.isnan(claimed) or math.isnan(true):
        return claimed.hex() == float(true).hex()
    return math.isclose(claimed, true, rel_tol=tolerance, abs_tol=tolerance)
