"""The origin of a data set, stamped into it."""

import dataclasses
import json
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any, Final

from colift.benchmark.episode.scenario import Scenario

STAMP: Final = "colift.json"
"""File of the origin in the folder of a data set."""

VIEWS: Final = ("robot", "both")
"""The parts of a lift that a set has: the robot's, or those of both agents."""


@dataclass(frozen=True, kw_only=True)
class Provenance:
    """The origin of the lifts of a data set."""

    name: str
    """Name of the data set: letters, digits, ``-`` and ``_``."""
    source: str
    """The command that made it."""
    policy: str
    """The agent at the robot's end, or the rule by which agents take turns."""
    policy_digest: str
    suite: str
    """The suite, or the rule of the set."""
    suite_digest: str
    """SHA-256 over all that determines the lifts' numbers; see :attr:`.Suite.digest`."""
    colift: str = dataclasses.field(default_factory=lambda: version("colift"))
    """Version of colift that simulated the lifts."""
    task: str
    partner: str
    """Holder of the robot's end: ``nao``, ``human`` or ``live``."""
    converted: bool
    """Whether a human's references at the robot's end were made into changes of a command."""
    control_period: float
    """Time between two decisions [s]."""
    latency: float
    """Age of the robot's motion capture [s]."""
    view: str
    """One of :data:`VIEWS`."""

    def plain(self) -> dict[str, Any]:
        """Return it for JSON."""
        return dataclasses.asdict(self)

    def text(self) -> str:
        """Return the content of :data:`STAMP`."""
        return json.dumps(self.plain(), indent=2) + "\n"


def of_scenario(scenario: Scenario) -> dict[str, Any]:
    """Return the fields of :class:`Provenance` that follow from a scenario."""
    return {
        "task": scenario.task.name,
        "partner": scenario.partner,
        "control_period": scenario.control_period,
        "latency": scenario.latency,
    }
