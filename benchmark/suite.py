"""Suites: named, immutable sets of episodes."""

import dataclasses
import hashlib
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any, Final

import numpy as np

from ..agents import agent
from ..agents.errors import InputError
from ..agents.humans import SUBJECTS, Recorded, load_recordings, scripted, stroke
from ..agents.humans import lift as human_lift
from . import lift, metrics
from .catalogue import RECORDED, make_scenario
from .scenario import Scenario
from .world import PHYSICS, SERVO, Partner, human_body, table

RULES: Final = 1
"""Number of the rules. It is raised by every change to the code that changes a score; parameters
enter the digest by themselves."""

PLAYED_BY: Final = (agent, lift, metrics, scripted, human_lift, stroke, table, human_body)
"""Modules whose constants change a score."""

BEHAVIOURS: Final = ("smooth", "pause", "jerky", "changing_goal")
"""The behaviours of the standard suites."""


@dataclass(frozen=True, kw_only=True)
class Suite:
    """A named tuple of scenarios, each played with a tuple of seeds."""

    name: str
    scenarios: tuple[Scenario, ...]
    seeds: tuple[int, ...]

    @property
    def size(self) -> int:
        """Number of episodes."""
        return len(self.scenarios) * len(self.seeds)

    @property
    def digest(self) -> str:
        """SHA-256 (16 hexadecimal digits) over everything that changes a number.

        Scenarios with all parameters of behaviour and subject, seeds, physics, the constants of
        the modules that play and score an episode, and :data:`RULES`.
        Results of different digests never share a table.
        """
        content = {
            "rules": RULES,
            "physics": [_plain(PHYSICS), _plain(SERVO)],
            "constants": {module.__name__: _constants(module) for module in PLAYED_BY},
            "scenarios": [_plain(scenario) for scenario in self.scenarios],
            "seeds": self.seeds,
        }
        text = json.dumps(content, sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def with_seeds(self, start: int, stop: int) -> "Suite":
        """Return the same scenarios on the seeds ``start`` to ``stop - 1``.

        Raises
        ------
        InputError
            If there is no seed in the range or one is negative.
        """
        if not 0 <= start < stop:
            raise InputError(f"seeds must be A:B with 0 <= A < B, got {start}:{stop}")
        name = f"{self.name}[{start}:{stop}]"
        return dataclasses.replace(self, name=name, seeds=tuple(range(start, stop)))

    def with_partner(self, partner: Partner) -> "Suite":
        """Return the same episodes with another holder of the robot's end.

        The human's plans stay the same: they follow from the seed and the scenario's name.
        """
        scenarios = tuple(
            dataclasses.replace(scenario, partner=partner) for scenario in self.scenarios
        )
        return dataclasses.replace(self, scenarios=scenarios)

    def with_timing(self, latency: float | None, control_period: float | None) -> "Suite":
        """Return the same episodes with another latency or control period [s].

        Raises
        ------
        InputError
            If a time is out of range.
        """
        changes: dict[str, Any] = {}
        if latency is not None:
            changes["latency"] = latency
        if control_period is not None:
            changes["control_period"] = control_period
        if not changes:
            return self
        told = ", ".join(f"{name} {value:g} s" for name, value in changes.items())
        return dataclasses.replace(
            self,
            name=f"{self.name} ({told})",
            scenarios=tuple(dataclasses.replace(scene, **changes) for scene in self.scenarios),
        )


def _constants(module: ModuleType) -> dict[str, Any]:
    """Return the module's own numbers: the names in capitals."""
    return {
        name: _plain(value)
        for name, value in vars(module).items()
        if name.isupper() and isinstance(value, int | float | tuple)
    }


def _plain(value: Any) -> Any:
    """Return a JSON-ready description of frozen parameters, with the names of their classes."""
    if dataclasses.is_dataclass(value):
        content = {
            field.name: _plain(getattr(value, field.name)) for field in dataclasses.fields(value)
        }
        return {"class": type(value).__name__, **content}
    if isinstance(value, np.ndarray):
        return hashlib.sha256(np.ascontiguousarray(value, "<f8").tobytes()).hexdigest()
    if isinstance(value, tuple | list):
        return [_plain(item) for item in value]
    return value


def _grid(name: str, behaviours: Sequence[str], seeds: int) -> Suite:
    """Return the suite of every behaviour with every subject."""
    scenarios = tuple(
        make_scenario(behaviour, subject) for behaviour in behaviours for subject in SUBJECTS
    )
    return Suite(name=name, scenarios=scenarios, seeds=tuple(range(seeds)))


def _quick() -> Suite:
    cells = zip(BEHAVIOURS, ("S1", "S2", "S3", "S5"), strict=True)
    scenarios = tuple(make_scenario(behaviour, subject) for behaviour, subject in cells)
    return Suite(name="quick-v1", scenarios=scenarios, seeds=(0, 1, 2))


SUITES: Final[dict[str, tuple[str, Callable[[], Suite]]]] = {
    "standard-v1": (
        "5 subjects x 4 behaviours x 15 lifts: the benchmark",
        lambda: _grid("standard-v1", BEHAVIOURS, 15),
    ),
    "paper-v1": (
        "5 subjects x 10 smooth lifts: the paper's Table I",
        lambda: _grid("paper-v1", ("smooth",), 10),
    ),
    "quick-v1": ("12 lifts, one cell of each behaviour: a first look", _quick),
}
"""The suites by name: one line about each, and what makes it."""


def make_suite(name: str) -> Suite:
    """Return the suite of that name.

    Raises
    ------
    InputError
        If the name is unknown; the message lists all names.
    """
    if name not in SUITES:
        raise InputError(f"unknown suite {name!r}; known: {', '.join(SUITES)}")
    return SUITES[name][1]()


def recorded_suite(path: Path) -> Suite:
    """Return a suite of recorded lifts: each trial once, the subjects' bodies in turn.

    Raises
    ------
    InputError
        If the file cannot be used; the message says where and why.
    """
    subjects = list(SUBJECTS.values())
    scenarios = tuple(
        Scenario(
            behaviour=RECORDED,
            human=Recorded(recording=recording),
            trial=recording.name,
            subject=subjects[i % len(subjects)],
        )
        for i, recording in enumerate(load_recordings(path))
    )
    return Suite(name=f"recordings {path.name}", scenarios=scenarios, seeds=(0,))
