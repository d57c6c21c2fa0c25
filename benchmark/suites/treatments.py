"""The treatments of the recordings that a suite plays."""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, Final

from colift.agents.humans import Recorded
from colift.agents.humans.treatment import Treatment, treatment_of
from colift.benchmark.suites.suite import Suite

TREATED: Final = tuple(field.name for field in fields(Treatment))
"""Names of the numbers of a treatment."""

Treatments = Mapping[str, Treatment]
"""Treatments by trial."""


def treatments(suite: Suite) -> Treatments:
    """Return the treatment of each recording of a suite; empty if it has none."""
    return {
        scenario.trial: treatment_of(scenario.human)
        for scenario in suite.scenarios
        if isinstance(scenario.human, Recorded)
    }


def plain_treatments(suite: Suite) -> list[dict[str, Any]]:
    """Return the treatments of a suite's recordings for JSON, one object per trial."""
    return [{"trial": trial, **each.plain()} for trial, each in treatments(suite).items()]
