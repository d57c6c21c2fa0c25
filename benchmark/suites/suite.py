"""Suites: named, immutable sets of episodes."""

import dataclasses
import hashlib
import itertools
import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, NamedTuple

from colift.agents.humans import Recorded, load_recordings
from colift.agents.humans.serial import Serial
from colift.base.errors import InputError
from colift.base.plugins import article, blaming
from colift.base.registry import SUITES, called, lookup
from colift.benchmark.episode.identity import plain, scores_hash
from colift.benchmark.episode.metric import Metrics
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.robots.robot import make_robot
from colift.benchmark.suites.catalogue import RECORDED, TASK, make_scenario, make_subject, make_task
from colift.benchmark.suites.ranges import RECORDED_PEOPLE
from colift.benchmark.suites.rules import scenarios_fault, seeds_fault

LONGEST_SUITE_NAME: Final = 200
"""Longest name of a suite [characters]."""


class Due(NamedTuple):
    """A lift of a suite, which is to be played."""

    place: int
    """Its place in the suite, counted from 0."""
    scenario: Scenario
    seed: int


def alike(lifts: Iterable[Due]) -> Iterator[tuple[Scenario, list[Due]]]:
    """Yield successive lifts of one scenario together, with the scenario."""
    for _, some in itertools.groupby(lifts, key=lambda due: id(due.scenario)):
        found = list(some)
        yield found[0].scenario, found


@dataclass(frozen=True, kw_only=True)
class Suite:
    """A named tuple of scenarios with one task, each played with a tuple of seeds.

    Raises
    ------
    InputError
        If there is no scenario or no seed, the scenarios have different tasks or equal names, or a
        seed is negative, not an integer, or given twice.
    """

    name: str
    scenarios: tuple[Scenario, ...]
    seeds: tuple[int, ...]

    def __post_init__(self) -> None:
        """Check that episodes are distinct, and that one table can have all of them."""
        fault = scenarios_fault(self.scenarios) or seeds_fault(self.seeds)
        if fault is not None:
            raise InputError(f"suite {self.name!r} {fault}")

    @property
    def size(self) -> int:
        """Number of episodes."""
        return len(self.scenarios) * len(self.seeds)

    def at(self, place: int) -> Due:
        """Return the lift at a place: scenario by scenario, each with all seeds.

        In a session, its person has learned nothing from the lifts before.
        """
        row, column = divmod(place, len(self.seeds))
        scenario = self.scenarios[row]
        if isinstance(scenario.human, Serial):
            scenario = dataclasses.replace(scenario, human=scenario.human.at(column))
        return Due(place, scenario, self.seeds[column])

    @property
    def session(self) -> int:
        """Lifts of a session, of which each scenario is one; 0 if lifts are independent."""
        return len(self.seeds) if isinstance(self.scenarios[0].human, Serial) else 0

    def counts(self, place: int) -> bool:
        """Return whether the lift at a place counts: all do, or the last ones of a session."""
        human = self.scenarios[place // len(self.seeds)].human
        if not isinstance(human, Serial):
            return True
        return place % len(self.seeds) >= len(self.seeds) - human.counted

    @property
    def hand_speed(self) -> float:
        """The fastest change of the hand command of its robot [m/s]."""
        return self.scenarios[0].seat.action_range(1.0)[1]

    @property
    def metrics(self) -> Metrics:
        """The metrics of its task."""
        return self.scenarios[0].task.metrics

    @property
    def digest(self) -> str:
        """SHA-256 (16 hexadecimal digits) over everything that changes a number.

        It covers the scenarios with all parameters of behaviour and subject, the seeds, and the
        code that plays and scores with all its numbers, without names and words.
        Results with different digests never share a table.
        """
        content = {
            "code": scores_hash(),
            "scenarios": [plain(scenario) for scenario in self.scenarios],
            "holders": {each.partner: plain(each.seat) for each in self.scenarios},
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

    def with_behaviours(self, behaviours: Sequence[str]) -> "Suite":
        """Return a suite of the same subjects and seeds, each subject with each of the behaviours.

        Raises
        ------
        InputError
            If there is no such behaviour.
        """
        first = self.scenarios[0]
        subjects = {scenario.subject.name: scenario.subject for scenario in self.scenarios}
        scenarios = tuple(
            dataclasses.replace(
                first, behaviour=made.behaviour, human=made.human, trial=made.trial, subject=subject
            )
            for made in map(make_scenario, behaviours)
            for subject in subjects.values()
        )
        name = plain_name(f"{self.name} ({', '.join(behaviours)})")
        return dataclasses.replace(self, name=name, scenarios=scenarios)

    def with_partner(self, partner: str) -> "Suite":
        """Return the same episodes with another holder of the robot's end.

        The human's plans stay the same: they follow from the seed and the scenario's name.
        """
        scenarios = tuple(
            dataclasses.replace(scenario, partner=partner) for scenario in self.scenarios
        )
        return dataclasses.replace(self, scenarios=scenarios)

    def with_robot(self, robot: str | None) -> "Suite":
        """Return the same episodes with another robot, by its name; None changes nothing.

        Raises
        ------
        InputError
            If there is no such robot.
        """
        if robot is None or robot == self.scenarios[0].partner:
            return self
        make_robot(robot)
        return dataclasses.replace(
            self.with_partner(robot), name=plain_name(f"{self.name} ({robot})")
        )

    def with_timing(self, latency: float | None, control_period: float | None) -> "Suite":
        """Return the same episodes with another latency or control period [s].

        With conditions, it is the latency of all lifts; jitter and losses remain.

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
        shown = ", ".join(f"{name} {value:g} s" for name, value in changes.items())
        return dataclasses.replace(
            self,
            name=f"{self.name} ({shown})",
            scenarios=tuple(_timed(scene, changes) for scene in self.scenarios),
        )


def _timed(scenario: Scenario, changes: Mapping[str, Any]) -> Scenario:
    """Return a scenario with another latency or control period [s]."""
    conditions, latency = scenario.conditions, changes.get("latency")
    if conditions is not None and latency is not None:
        conditions = dataclasses.replace(conditions, latency=(latency, latency))
    return dataclasses.replace(scenario, conditions=conditions, **changes)


def plain_name(name: str) -> str:
    """Return a name in plain ASCII, so that no two suites have names that look alike."""
    plain = re.sub(r"[^A-Za-z0-9 ._()\[\]:,+-]", "_", name)
    return " ".join(plain.split())[:LONGEST_SUITE_NAME].strip()


def make_suite(name: str) -> Suite:
    """Return the suite that is registered under ``name``.

    Raises
    ------
    InputError
        If the name is unknown, or there is no suite of that name in its package.
    """
    function = lookup(SUITES, name)
    title = called(SUITES, name)
    with blaming(title, function):
        suite: object = function()
    if not isinstance(suite, Suite):
        raise InputError(f"{title} must return a Suite, got {article(suite)}")
    if suite.name != name:
        raise InputError(
            f"{title} returned a suite named {suite.name!r}; it must have its entry point's name"
        )
    return suite


def recorded_suite(path: Path) -> Suite:
    """Return a suite of recorded lifts, scaled: each trial once, with the body of a drawn person.

    Raises
    ------
    InputError
        If the file cannot be used; the message states the place and the reason.
    """
    scenarios = tuple(
        Scenario(
            behaviour=RECORDED,
            human=Recorded(recording=recording),
            trial=recording.name,
            subject=make_subject(f"draw-{RECORDED_PEOPLE[i % len(RECORDED_PEOPLE)]}"),
            task=make_task(TASK),
        )
        for i, recording in enumerate(load_recordings(path))
    )
    return Suite(name=plain_name(f"recordings {path.name}"), scenarios=scenarios, seeds=(0,))
