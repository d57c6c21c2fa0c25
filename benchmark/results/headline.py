"""The numbers that stand for a policy, in words: the same wherever they are printed."""

from collections.abc import Mapping, Sequence
from typing import Any


def headline(summary: Mapping[str, Any]) -> str:
    """Return error and ``vs_human`` of a summary in one line; see :func:`.summary.summarise`."""
    told = error(summary)
    return told if summary["vs_human"] is None else f"{told}; {versus_human(summary)}"


def error(summary: Mapping[str, Any]) -> str:
    """Return the mean RMSE [mm] with its interval."""
    rmse = summary["rmse_mm"]
    return f"RMSE {rmse['mean']:.2f} mm{_interval(rmse['ci95'])}"


def versus_human(summary: Mapping[str, Any]) -> str:
    """Return the ratio to the human-human team's RMSE with its interval."""
    ratio = summary["vs_human"]
    return f"vs_human {ratio['mean']:.2f}{_interval(ratio['ci95'])}"


def _interval(ci95: Sequence[float]) -> str:
    """Return the interval in words, or nothing if it has no width."""
    low, high = ci95
    return f" (95 % interval {low:.2f} to {high:.2f})" if high > low else ""
