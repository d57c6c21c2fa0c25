"""Formats of numbers and names on pages."""

from typing import Final

from colift.benchmark.statistics import Estimate

NONE: Final = "\N{EN DASH}"
"""Shown for a missing number."""

MINUS: Final = "\N{MINUS SIGN}"


def number(value: float | None, places: int = 1) -> str:
    """Return a number with a given number of decimals."""
    if value is None:
        return NONE
    text = f"{value:.{places}f}"
    return text.lstrip("-") if float(text) == 0 else text.replace("-", MINUS)


def signed(value: float | None, places: int = 1) -> str:
    """Return a number with its sign."""
    text = number(value, places)
    return f"+{text}" if value is not None and float(f"{value:.{places}f}") > 0 else text


def interval(estimate: Estimate, places: int = 1) -> str:
    """Return a 95 % interval as text; empty if there is none, or it has no width."""
    low, high = estimate.ends
    return f"{number(low, places)} to {number(high, places)}" if high > low else ""


def words(name: str) -> str:
    """Return a name of the code, such as ``changing_goal``, as words."""
    return name.replace("_", " ")


FORMATS: Final = {each.__name__: each for each in (number, signed, interval, words)}
"""The formats by name, for templates."""
