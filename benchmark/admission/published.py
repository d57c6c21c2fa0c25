"""Published figures of two people, to hold the simulated pair of a task to."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..execution.runner import Run
from ..tasks.intent.task import Intent


@dataclass(frozen=True, kw_only=True)
class Published:
    """A published figure of two people, and the same of a run of the human-human baseline."""

    what: str
    """The figure in words."""
    unit: str
    low: float
    high: float
    """The interval that is published, or follows from what is."""
    source: str
    """Who published it, and how the interval follows."""
    measure: Callable[[Run], float]
    """Returns the figure of a run."""


def negotiation_s(run: Run) -> float:
    """Return how much longer two people take to a pose that has to be found out [s].

    The mean time to the right pose where the far end stays or moves the other way, less that where
    the table stays level.
    """
    times = {
        found: [
            each.scores["settling_ms"] / 1000
            for each in run.episodes
            if (each.behaviour == "together") != found and each.failure is None
        ]
        for found in (True, False)
    }
    return float(np.mean(times[True]) - np.mean(times[False]))


PUBLISHED: Final[Mapping[str, Published]] = {
    Intent.name: Published(
        what="what a negotiation costs",
        unit="s",
        low=0.19,
        high=1.65,
        source="Rysbek et al. 2023 (arXiv 2308.09177), from their annotations: pairs who "
        "negotiate choose a goal after 2.49 to 3.95 s (quartiles), others after 2.30 s (median)",
        measure=negotiation_s,
    ),
}
"""The published figure for each task that has one."""
