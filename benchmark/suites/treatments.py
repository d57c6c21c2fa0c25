"""The treatments of the recordings that a suite plays."""

from collections.abc import Iterator, Mapping
from dataclasses import fields
from typing import Any, Final

from colift.agents.humans import Recorded
from colift.agents.humans.treatment import Treatment, treatment_of
from colift.benchmark.suites.suite import Due, Suite

TREATED: Final = tuple(field.name for field in fields(Treatment))
"""Names of the numbers of a treatment."""

Treatments = Mapping[tuple[str, int], Treatment]
"""Treatments by the trial and the seed of a lift."""


def treatments(suite: Suite) -> Treatments:
    """Return the treatment of each recording of a suite; empty if it has none."""
    return {(due.scenario.trial, due.seed): treatment_of(human) for due, human in _recorded(suite)}


def plain_treatments(suite: Suite) -> list[dict[str, Any]]:
    """Return the treatments of a suite's recordings for JSON, one object per trial."""
    return [
        {"trial": human.recording.name, **treatment_of(human).plain()}
        for _, human in _recorded(suite)
    ]


def _recorded(suite: Suite) -> Iterator[tuple[Due, Recorded]]:
    """Yield the lifts of a suite that were recorded."""
    for due in map(suite.at, range(suite.size)):
        if isinstance(due.scenario.human, Recorded):
            yield due, due.scenario.human
