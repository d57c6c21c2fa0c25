"""Sources of real lifts, each played as a separate suite."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from colift.agents.humans import Recorded, load_trials
from colift.agents.humans.copies import first_copy
from colift.base.errors import InputError
from colift.benchmark.pairs.recorded import PairLift, pair_lifts
from colift.benchmark.real_lifts.suites import real_lifts
from colift.benchmark.suites.catalogue import AS_RECORDED
from colift.benchmark.suites.suite import Suite, plain_name

FEWEST_LIFTS: Final = 2
"""Fewest lifts of a source: a single lift has no spread, and therefore no interval."""

FEWEST_PEOPLE: Final = 2
"""Fewest people of a source, if its file names them: intervals are between people."""


@dataclass(frozen=True, kw_only=True)
class Source:
    """Real lifts of one origin."""

    name: str
    """Name in tables: that of the file or folder."""
    kind: str
    """The kind of data: ``recordings``, ``as_recorded`` if they are not scaled, or ``live`` for
    lifts of ``colift play``."""
    suite: Suite
    """Its lifts, to be played with any policy."""
    left_out: Mapping[str, str] = field(default_factory=dict)
    """The reason why each other lift does not count, by its name."""
    pairs: Mapping[str, PairLift] = field(default_factory=dict)
    """The lifts of which both ends were recorded, by trial, if they are played as recorded."""


def source_of(path: Path, *, as_recorded: bool = False) -> Source:
    """Return the real lifts in a file of recordings, or in the folder of a session of live lifts.

    The source has the name of the file or of the folder. Recordings are scaled and slowed down
    unless ``as_recorded``.

    Raises
    ------
    InputError
        If it cannot be used, or has fewer than :data:`FEWEST_LIFTS` lifts or
        :data:`FEWEST_PEOPLE` people.
    """
    lifts = real_lifts(path, as_recorded=as_recorded)
    suite = lifts.suite
    if suite.size < FEWEST_LIFTS:
        raise InputError(
            f"{path} has {suite.size} lift; intervals need {FEWEST_LIFTS} or more, and say little "
            "below ten"
        )
    people = {scenario.person for scenario in suite.scenarios}
    if len(people) < FEWEST_PEOPLE:
        raise InputError(
            f"{path}: all lifts are of {next(iter(people))!r:.80}; intervals are between people, "
            f"and need {FEWEST_PEOPLE} or more"
        )
    if path.is_dir():
        return Source(name=plain_name(path.stem), kind="live", suite=suite, left_out=lifts.left_out)
    return Source(
        name=plain_name(f"{path.stem} as recorded" if as_recorded else path.stem),
        kind=AS_RECORDED if as_recorded else "recordings",
        suite=suite,
        left_out=lifts.left_out,
        pairs={each.name: each for each in pair_lifts(load_trials(path)) if as_recorded},
    )


def sources_of(paths: Sequence[Path], *, as_recorded: bool = False) -> tuple[Source, ...]:
    """Return the sources of some files and folders, in their order; see :func:`source_of`.

    Raises
    ------
    InputError
        As :func:`source_of`, or if two have the same name or share a lift.
    """
    found = tuple(source_of(path, as_recorded=as_recorded) for path in paths)
    name, count = Counter(source.name for source in found).most_common(1)[0]
    if count > 1:
        raise InputError(f"{count} sources are called {name!r}; give each source a name of its own")
    recorded = [
        (source.name, scenario.human.recording)
        for source in found
        for scenario in source.suite.scenarios
        if isinstance(scenario.human, Recorded)
    ]
    copy = first_copy([recording for _, recording in recorded])
    if copy is not None:
        (one, lift), (other, again) = (recorded[index] for index in copy)
        raise InputError(
            f"{other} has the lift {lift.name!r:.80} of {one}, as {again.name!r:.80}: a lift can "
            "confirm a suite once; leave one of them out"
        )
    return found
