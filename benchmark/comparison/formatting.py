"""Numbers as the tables of a comparison show them."""

from colift.benchmark.statistics import Interval


def digits(value: float) -> str:
    """Return the format of a positive number in which it has two digits or more."""
    if value < 1:
        return ".2f"
    return ".1f" if value < 100 else ".0f"


def between(interval: Interval | None, digits: str) -> str:
    """Return an interval in words; nothing if there is none, or if it has no width."""
    low, high = interval or (0.0, 0.0)
    return f"{low:{digits}} to {high:{digits}}" if high > low else ""


def p_value(p: float) -> str:
    """Return a p value; small ones as a bound."""
    return "< 0.001" if p < 0.001 else f"{p:.3f}"


def probability(value: float | None) -> str:
    """Return a probability; one that is nearly 1 as a bound, and nothing for None."""
    if value is None:
        return ""
    if value < 0.005:
        return "< 0.01"
    return "> 0.99" if value >= 0.995 else f"{value:.2f}"
