"""The headline numbers of a policy, in words: the same wherever they are printed."""

from colift.benchmark.results.summary import Summary
from colift.benchmark.statistics import Interval


def headline(summary: Summary) -> str:
    """Return error and ``vs_human`` of a summary in one line; see :func:`.summary.summarise`."""
    return "; ".join(filter(None, (error(summary), versus_human(summary))))


def error(summary: Summary) -> str:
    """Return the mean RMSE [mm] with its interval."""
    return f"RMSE {summary.rmse_mm.mean:.2f} mm{_interval(summary.rmse_mm.ci95)}"


def versus_human(summary: Summary) -> str:
    """Return the ratio to the RMSE of two people; empty without this baseline."""
    ratio = summary.vs_human
    return "" if ratio is None else f"vs_human {ratio.mean:.2f}{_interval(ratio.ci95)}"


def _interval(ci95: Interval | None) -> str:
    """Return the interval in words; empty if there is none."""
    return "" if ci95 is None else f" (95 % interval {ci95[0]:.2f} to {ci95[1]:.2f})"
