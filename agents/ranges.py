"""Ranges of parameters: each field of a dataclass states its own, and one function checks all."""

import math
from functools import cache
from typing import Annotated, Any, NamedTuple, get_type_hints

from colift.base.errors import InputError


class Range(NamedTuple):
    """The numbers that a parameter may have; none of them is infinite."""

    low: float
    high: float
    words: str
    open: bool = False
    """Whether the lower end is not one of them."""

    def has(self, value: float) -> bool:
        """Return whether a value is in the range."""
        above = value > self.low if self.open else value >= self.low
        return above and value <= self.high and math.isfinite(value)


Positive = Annotated[float, Range(0.0, math.inf, "a positive number", open=True)]
NotNegative = Annotated[float, Range(0.0, math.inf, "a number of at least 0")]
Probability = Annotated[float, Range(0.0, 1.0, "a number from 0 to 1")]
Shares = Annotated[tuple[float, ...], Range(-math.inf, math.inf, "a number")]


def check_ranges(parameters: object) -> None:
    """Check every field of a dataclass that states a :class:`Range`.

    Raises
    ------
    InputError
        If a value is outside its range; the message names it.
    """
    owner: Any = type(parameters)
    for name, allowed in _ranges(owner).items():
        value = getattr(parameters, name)
        for each in value if isinstance(value, tuple) else (value,):
            if not allowed.has(each):
                raise InputError(f"{name} must be {allowed.words}, got {each}")


@cache
def _ranges(owner: type) -> dict[str, Range]:
    hints: dict[str, Any] = get_type_hints(owner, include_extras=True)
    return {
        name: stated
        for name, hint in hints.items()
        for stated in getattr(hint, "__metadata__", ())
        if isinstance(stated, Range)
    }
