"""Policies on the same episodes: played now, or stored in bundles."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

import numpy as np

from ...agents.errors import InputError, Remedy
from ...agents.spec import AgentSpec
from ..bundle import FILES, read_bundle
from ..episode.metric import SCORING, Metric, Scores, on_boards
from ..execution.runner import Run, run_suite
from ..results.baselines import (
    HUMAN_HUMAN,
    HUMAN_HUMAN_LABEL,
    Baseline,
    human_human_run,
    shipped_baselines,
    shipped_bounds,
)
from ..results.summary import Stratum, stratum
from ..suites.suite import Suite


@dataclass(frozen=True, kw_only=True, eq=False)
class Entry:
    """One policy's scores, episode by episode. The traces are not kept: there are many policies."""

    name: str
    digest: str
    """Hash of the policy's source."""
    strata: tuple[Stratum, ...]
    """Behaviour and subject of each episode, in the suite's order."""
    scores: tuple[Scores, ...]
    failures: tuple[str | None, ...]
    """Why an episode failed, or nothing if it did not."""
    step_ms: tuple[float, float] | None
    """Median and 99th percentile of the time of a step [ms]; nothing if it never made one."""

    @classmethod
    def of(cls, name: str, run: Run) -> "Entry":
        """Return what is kept of a run, under the name that tables use."""
        times = [1000 * time for episode in run.episodes for time in episode.step_times]
        p50, p99 = np.percentile(times, [50, 99]) if times else (0.0, 0.0)
        return cls(
            name=name,
            digest=run.policy_digest,
            strata=tuple(stratum(episode) for episode in run.episodes),
            scores=tuple(episode.scores for episode in run.episodes),
            failures=tuple(episode.failure for episode in run.episodes),
            step_ms=(float(p50), float(p99)) if times else None,
        )


class Bound(Protocol):
    """Plays a suite with a robot that is no policy, as far as such a robot can come."""

    def __call__(
        self, suite: Suite, *, executor: Executor | None, progress: Callable[[int], None]
    ) -> Run:
        """Return its run; arguments as for :func:`.run_suite`."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Contest:
    """Policies and the human-human baseline on the same episodes."""

    suite: Suite
    entries: tuple[Entry, ...]
    human_human: Baseline
    """The human-human baseline."""
    bounds: Mapping[str, Baseline] = field(default_factory=dict)
    """What no policy is expected to beat."""

    @property
    def metrics(self) -> tuple[Metric, ...]:
        """The metrics that are compared beside RMSE."""
        return on_boards(self.suite.metrics)

    @property
    def baselines(self) -> dict[str, Baseline]:
        """The human-human baseline, then the bounds, by name; none has a rank."""
        return {HUMAN_HUMAN_LABEL: self.human_human, **self.bounds}


def amount(policies: int, suite: Suite, *, bounds: int = 0) -> int:
    """Return how many episodes :func:`play_contest` will play with so many policies and bounds."""
    human_human = shipped_baselines(suite) is None
    return suite.size * (policies + human_human + bounds * (shipped_bounds(suite) is None))


def play_contest(
    policies: Mapping[str, AgentSpec],
    suite: Suite,
    *,
    stored: Sequence[Entry] = (),
    bounds: Mapping[str, Bound] | None = None,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Contest:
    """Play the suite with every policy; and with the human-human baseline and bounds not shipped.

    Parameters
    ----------
    policies
        Where each policy is, by the name that tables use.
    suite, executor, progress
        As for :func:`.run_suite`.
    stored
        Policies that have played the suite before.
    bounds
        Bounds to play, by name, if there are none shipped: those are there in any case.

    Raises
    ------
    InputError
        If a policy cannot be loaded.
    KeyboardInterrupt
        After Ctrl-C: without all episodes there are no pairs.
    """
    entries = [
        Entry.of(name, run_suite(spec, suite, executor=executor, progress=progress))
        for name, spec in policies.items()
    ]
    bounding = shipped_bounds(suite)
    if bounding is None:
        bounding = play_bounds(bounds or {}, suite, executor=executor, progress=progress)
    shipped = shipped_baselines(suite)
    if shipped is None:
        human_human = Baseline.of(human_human_run(suite, executor=executor, progress=progress))
    else:
        human_human = shipped[HUMAN_HUMAN]
    return Contest(
        suite=suite, entries=(*entries, *stored), human_human=human_human, bounds=bounding
    )


def play_bounds(
    bounds: Mapping[str, Bound],
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> dict[str, Baseline]:
    """Return how far each of the bounds comes on a suite; arguments as of :func:`play_contest`."""
    return {
        name: Baseline.of(play(suite, executor=executor, progress=progress))
        for name, play in bounds.items()
    }


@dataclass(frozen=True, kw_only=True, eq=False)
class Stored:
    """A bundle's scores, as it claims them, and the suite that they are of."""

    folder: Path
    entry: Entry
    suite: Suite


def is_bundle(folder: Path) -> bool:
    """Return whether a folder has the files of a bundle; they are not read."""
    return all((folder / name).is_file() for name in FILES)


def read_stored(folder: Path) -> Stored:
    """Return the scores in a bundle.

    Raises
    ------
    InputError
        If it is damaged, not complete, or its scores are not those of this version of colift.
    """
    try:
        bundle = read_bundle(folder)
        run = bundle.run()
    except InputError as error:
        raise InputError(f"{folder}: {error}") from error
    content = bundle.results
    if not (content["complete"] and run.complete):
        raise InputError(
            f"{folder} has {len(run.episodes)} of {run.suite.size} lifts: run the rest"
        )
    if content["scoring"] != SCORING:
        raise InputError(
            f"{folder} has scores of version {content['scoring']}, this colift computes version "
            f"{SCORING}",
            remedy=Remedy.RESCORE,
            target=str(folder),
        )
    if content["suite_digest"] != run.suite.digest:
        raise InputError(
            f"{folder} was played on {content['suite']} with digest {content['suite_digest']}; "
            f"here that suite has digest {run.suite.digest}: run the policy again"
        )
    step = content["summary"]["step_ms"]
    entry = Entry.of(run.policy, run)
    if step["p50"] is not None and step["p99"] is not None:
        entry = dataclasses.replace(entry, step_ms=(step["p50"], step["p99"]))
    return Stored(folder=folder, entry=entry, suite=run.suite)


def check_same_suite(stored: Sequence[Stored], suite: Suite) -> None:
    """Raise an InputError if a bundle is of other lifts than those of a suite."""
    for each in stored:
        if each.suite.digest != suite.digest:
            raise InputError(
                f"{each.folder} has the lifts of {each.suite.name} (digest {each.suite.digest}), "
                f"not of {suite.name} (digest {suite.digest}): policies are compared on the same"
            )
