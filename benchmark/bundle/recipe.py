"""The recipe for making the episodes of a bundle again."""

import csv
import io
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final, Self

from colift.agents.humans import AsRecorded, Behaviour, Recorded, Recording, load_recordings
from colift.agents.humans.recorded_series import RecordedSeries, series_of
from colift.agents.humans.recordings import COLUMNS, PERSON
from colift.base.errors import InputError
from colift.base.registry import UnknownNameError
from colift.benchmark.bundle.files import INPUTS, MANIFEST, RECORDINGS
from colift.benchmark.bundle.inputs import dump_inputs, parse_inputs
from colift.benchmark.bundle.json_text import of_type, pick
from colift.benchmark.channels import Channel
from colift.benchmark.channels.recorded import parse_recorded, recorded
from colift.benchmark.episode.conditions import Conditions, read_conditions
from colift.benchmark.episode.metric import Metrics
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.suites.catalogue import (
    AS_RECORDED,
    FROM_FILES,
    PLAYED,
    RECORDED,
    SERIES,
    make_scenario,
    make_subject,
    make_task,
)
from colift.benchmark.suites.suite import LONGEST_SUITE_NAME, Suite, plain_name
from colift.benchmark.tasks.level.task import LEVEL

MOST_EPISODES: Final = 100_000
"""Largest number of episodes in a bundle."""

SEED_BITS: Final = 128
"""Largest number of bits of a seed."""

LONGEST_NAME: Final = 1000

FROM_NAMES: Final = (
    "its behaviours, subjects and task must be registered, with their own parameters, and its "
    "scenarios must have the same partner, timing and conditions"
)
"""Condition on suites that have a recipe."""

CONDITIONS: Final = "conditions"
"""The key of the conditions; without it there are none."""

FILES: Final = {**dict.fromkeys(FROM_FILES, RECORDINGS), PLAYED: INPUTS}
"""The file with the trials of a behaviour."""


@dataclass(frozen=True, kw_only=True)
class Recipe:
    """Names and numbers that define a suite, and those of the channel to the policy."""

    name: str
    """The suite's name."""
    scenarios: tuple[tuple[str, str, str], ...]
    """Behaviour, subject and trial of each scenario."""
    seeds: tuple[int, ...]
    partner: str
    control_period: float
    latency: float
    task: str = LEVEL.name
    conditions: Conditions | None = None
    """Ranges of what is drawn for each lift; None if nothing is."""
    recordings: bytes | None = None
    """The recordings as a CSV file, if recorded lifts are played."""
    inputs: bytes | None = None
    """The hands of live lifts, if those are played; see :mod:`.inputs`."""
    channel: Channel | None = None
    """The channel between the robot and the policy; None if there is none."""

    @classmethod
    def of(cls, suite: Suite, channel: Channel | None = None) -> Self | None:
        """Return the recipe of a suite and a channel; None if it cannot be made from names.

        This is the case for behaviours and subjects that are not registered, or whose parameters
        were changed, and for scenarios that differ in partner, timing, conditions or task.
        """
        first = suite.scenarios[0]
        recipe = cls(
            name=suite.name,
            scenarios=tuple((s.behaviour, s.subject.name, s.trial) for s in suite.scenarios),
            seeds=suite.seeds,
            partner=first.partner,
            control_period=float(first.control_period),
            latency=float(first.latency),
            task=first.task.name,
            conditions=first.conditions,
            recordings=_recordings(suite.scenarios),
            inputs=dump_inputs(suite.scenarios),
            channel=channel,
        )
        try:
            made = cls.parse(recipe.plain(), recipe.recordings, recipe.inputs).suite()
        except InputError:
            return None
        return recipe if made.digest == suite.digest else None

    def suite(self) -> Suite:
        """Return the suite.

        Raises
        ------
        InputError
            If a name is unknown or given twice, a number out of range, or the recordings cannot be
            used.
        """
        humans: dict[tuple[str, str], Behaviour] = {}
        if self.recordings is not None:
            recordings = _load(self.recordings)
            for recording in recordings:
                humans[RECORDED, recording.name] = Recorded(recording=recording)
                humans[AS_RECORDED, recording.name] = AsRecorded(recording=recording)
            for name, series in series_of(recordings).items():
                humans[SERIES, name] = series
        if self.inputs is not None:
            played = parse_inputs(self.inputs, len(self.scenarios))
            trials = [trial for _, _, trial in self.scenarios]
            humans.update(
                {(PLAYED, trial): human for trial, human in zip(trials, played, strict=True)}
            )
        with _in_manifest():
            scenarios = tuple(self._scenario(*names, humans) for names in self.scenarios)
            return Suite(name=self.name, scenarios=scenarios, seeds=self.seeds)

    def metrics(self) -> Metrics:
        """Return the metrics of the task.

        Raises
        ------
        InputError
            If there is no task of that name.
        """
        with _in_manifest():
            return make_task(self.task).metrics

    def _scenario(
        self,
        behaviour: str,
        subject: str,
        trial: str,
        humans: Mapping[tuple[str, str], Behaviour],
    ) -> Scenario:
        if behaviour in FILES:
            human = humans.get((behaviour, trial))
            if human is None:
                raise InputError(f"{FILES[behaviour]} has no trial {trial!r:.80}")
            return Scenario(
                behaviour=behaviour,
                human=human,
                trial=trial,
                subject=make_subject(subject),
                partner=self.partner,
                control_period=self.control_period,
                latency=self.latency,
                task=make_task(self.task),
            )
        # A name with a colon would name a file.
        if trial or ":" in behaviour:
            raise InputError(f"there is no behaviour {behaviour!r:.80} with trial {trial!r:.80}")
        made = make_scenario(
            behaviour, subject, self.partner, self.control_period, self.latency, self.task
        )
        return replace(made, conditions=self.conditions)

    def plain(self) -> dict[str, Any]:
        """Return the recipe for JSON: everything except recordings and hands."""
        content = {
            "suite": self.name,
            "partner": self.partner,
            "control_period": self.control_period,
            "latency": self.latency,
            "task": self.task,
            "seeds": list(self.seeds),
            "scenarios": ["/".join(filter(None, names)) for names in self.scenarios],
        }
        if self.conditions is not None:
            content[CONDITIONS] = self.conditions.plain()
        return content if self.channel is None else {**content, "channel": recorded(self.channel)}

    @classmethod
    def parse(
        cls, content: dict[str, Any], recordings: bytes | None, inputs: bytes | None = None
    ) -> Self:
        """Return the recipe from the content of :meth:`plain`, the recordings and the hands.

        Raises
        ------
        InputError
            If something is missing, of the wrong type or out of range.
        """
        scenarios = [
            of_type(names, str, f"{MANIFEST}: a scenario")
            for names in pick(content, "scenarios", list, MANIFEST)
        ]
        seeds = [
            of_type(seed, int, f"{MANIFEST}: a seed")
            for seed in pick(content, "seeds", list, MANIFEST)
        ]
        if not 0 < len(scenarios) * len(seeds) <= MOST_EPISODES:
            raise InputError(f"{MANIFEST}: there must be 1 to {MOST_EPISODES} episodes")
        if min(seeds) < 0 or max(seeds).bit_length() > SEED_BITS:
            raise InputError(f"{MANIFEST}: seeds must be from 0 to 2^{SEED_BITS} - 1")
        if max(map(len, scenarios)) > LONGEST_NAME:
            raise InputError(f"{MANIFEST}: a scenario's name is too long")
        name = pick(content, "suite", str, MANIFEST)
        if not name or plain_name(name) != name:
            raise InputError(
                f"{MANIFEST}: the suite's name is {name!a:.80}, must be 1 to "
                f"{LONGEST_SUITE_NAME} letters, digits, single blanks or ._()[]:,+- of ASCII"
            )
        recipe = cls(
            name=name,
            scenarios=tuple(_names(name) for name in scenarios),
            seeds=tuple(seeds),
            partner=pick(content, "partner", str, MANIFEST),
            control_period=pick(content, "control_period", float, MANIFEST),
            latency=pick(content, "latency", float, MANIFEST),
            task=pick(content, "task", str, MANIFEST),
            conditions=_conditions(content),
            recordings=recordings,
            inputs=inputs,
            channel=_channel(content),
        )
        if recipe.plain() != content:
            raise InputError(f"{MANIFEST}: the recipe is not as colift writes it")
        return recipe


@contextmanager
def _in_manifest() -> Iterator[None]:
    """Put the manifest's name before the message of an InputError."""
    try:
        yield
    except UnknownNameError as error:
        hint = "or the package that registers it is not installed"
        raise InputError(f"{MANIFEST}: {error}; {hint}") from None
    except InputError as error:
        raise InputError(f"{MANIFEST}: {error}") from None


def _channel(content: dict[str, Any]) -> Channel | None:
    if "channel" not in content:
        return None
    channel = pick(content, "channel", dict, MANIFEST)
    return parse_recorded(channel, f"{MANIFEST}: channel")


def _conditions(content: dict[str, Any]) -> Conditions | None:
    if CONDITIONS not in content:
        return None
    ranges = pick(content, CONDITIONS, dict, MANIFEST)
    return read_conditions(ranges, f"{MANIFEST}: {CONDITIONS}")


def _names(name: str) -> tuple[str, str, str]:
    """Return behaviour, subject and trial of a scenario's name; a trial may have slashes."""
    behaviour, _, rest = name.partition("/")
    subject, _, trial = rest.partition("/")
    return behaviour, subject, trial


def _recordings(scenarios: tuple[Scenario, ...]) -> bytes | None:
    """Return the recordings of the scenarios as a CSV file; None if there are none."""
    recordings: dict[str, Recording] = {}
    for human in (scenario.human for scenario in scenarios):
        if isinstance(human, Recorded):
            lifts = human.lifts if isinstance(human, RecordedSeries) else (human.recording,)
            recordings |= {recording.name: recording for recording in lifts}
    if not recordings:
        return None
    text = io.StringIO()
    writer = csv.writer(text, quoting=csv.QUOTE_NONNUMERIC, lineterminator="\n")
    known = any(recording.person for recording in recordings.values())
    writer.writerow((*COLUMNS, PERSON) if known else COLUMNS)
    for name, recording in recordings.items():
        person = (recording.person,) if known else ()
        for time, height in zip(recording.times, recording.heights, strict=True):
            writer.writerow((name, time, height, *person))
    return text.getvalue().encode(errors="replace")


def _load(recordings: bytes) -> tuple[Recording, ...]:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / RECORDINGS
        path.write_bytes(recordings)
        try:
            return load_recordings(path)
        except InputError as error:
            raise InputError(str(error).replace(str(path), RECORDINGS)) from None
