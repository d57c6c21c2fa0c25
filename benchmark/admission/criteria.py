"""The criteria of admission, each with a figure, a bar and its meaning."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Final

import numpy as np
from colift.benchmark.admission.published import Published
from colift.benchmark.admission.variance import variance_shares
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.scores import ScoreTable, stratum
from colift.benchmark.statistics import Units, paired_difference
from numpy.typing import NDArray

ROOM: Final = 3.0
"""Least error of the best level-keeper, as a multiple of the oracle's."""

INTERACTION: Final = 0.2
"""Least share of the variance that is interaction of policy and human."""

IDLE: Final = 2.0
"""Least error of a robot that does nothing, as a multiple of the human-human baseline's."""


@dataclass(frozen=True, kw_only=True)
class Criterion:
    """One criterion, as measured."""

    letter: str
    what: str
    """The condition in words."""
    figure: float | None
    """The measured figure; None if there was nothing to measure."""
    bar: str
    """The limit of the figure, in words."""
    passed: bool | None
    """Whether the figure is within the limit; None if there was nothing to measure."""
    detail: str
    """The underlying figures, in words."""


def room(oracle: float, keepers: Mapping[str, Run]) -> Criterion:
    """Return whether an oracle with this mean RMSE [mm] is far better than a level table."""
    best = min(keepers, key=lambda name: mean_mm(keepers[name]))
    ratio = mean_mm(keepers[best]) / oracle
    return Criterion(
        letter="a",
        what="an oracle is far better than the best level-keeper",
        figure=ratio,
        bar=f"at least {ROOM:g}",
        passed=ratio >= ROOM,
        detail=f"{best} {mean_mm(keepers[best]):.2f} mm, oracle {oracle:.2f} mm",
    )


def interaction(runs: Mapping[str, Run], trained: Mapping[str, Run]) -> Criterion:
    """Return whether the best policy depends on the person.

    Parameters
    ----------
    runs
        Runs of policies designed by hand, each with its own assumptions about people.
    trained
        Runs of policies that were trained with the suite's population. They are reported, but do
        not count: a policy that has learned to cooperate with everybody leads everywhere, and its
        lead adds to the variance of policies, however different the people are.
    """
    people = list(dict.fromkeys(each.subject for each in next(iter(runs.values())).episodes))

    def by_person(some: Mapping[str, Run]) -> list[list[float]]:
        return [[_log_mean(run, person) for person in people] for run in some.values()]

    shares, all_shares = (variance_shares(by_person(some)) for some in (runs, {**runs, **trained}))
    cells = list(dict.fromkeys(stratum(each) for each in next(iter(runs.values())).episodes))
    fine = variance_shares(
        [[_log_mean(run, person, way) for way, person in cells] for run in runs.values()]
    )
    return Criterion(
        letter="b",
        what="which policy is good depends on the human: share of the variance",
        figure=shares.interaction,
        bar=f"at least {INTERACTION:g}",
        passed=shares.interaction >= INTERACTION,
        detail=f"policy {shares.policy:.2f}, person {shares.human:.2f}, interaction "
        f"{shares.interaction:.2f}; with persons and behaviours {fine.interaction:.2f}"
        + (f"; with {', '.join(trained)} {all_shares.interaction:.2f}" if trained else ""),
    )


def rank_changes(runs: Mapping[str, Run]) -> Criterion:
    """Return whether two policies exist, each better than the other with some person."""
    changes = []
    for one, other in combinations(runs, 2):
        better = _better_with(runs[one], runs[other])
        if better[0] and better[1]:
            changes.append(f"{one} with {better[0][0]}, {other} with {better[1][0]}")
    return Criterion(
        letter="c",
        what="policies change rank between people, beyond chance",
        figure=float(len(changes)),
        bar="at least 1 pair",
        passed=bool(changes),
        detail=changes[0] if changes else "no pair",
    )


def conventions(played: NDArray[np.float64] | None) -> Criterion:
    """Return whether pairs that were trained apart do better with their own partners.

    Parameters
    ----------
    played
        (n, n) mean RMSE of each person with each robot of n pairs [mm]; None: no pair was trained.
    """
    stated = Criterion(
        letter="d",
        what="pairs that learned apart fail with each other's partners: error across, over own",
        figure=None,
        bar="stated",
        passed=None,
        detail="no pair was trained for this test: nothing is known",
    )
    if played is None:
        return stated
    count = len(played)
    own = float(played.trace()) / count
    across = (float(played.sum()) - count * own) / (count * (count - 1))
    words = "they do better with themselves" if across > own else "they do not"
    detail = f"{count} pairs in the twin: {own:.2f} mm with themselves, {across:.2f} mm across"
    return replace(stated, figure=across / own, passed=True, detail=f"{detail}: {words}")


def like_people(human_human: Run, published: Published) -> Criterion:
    """Return whether the simulated pair lies in a published interval."""
    found = published.measure(human_human)
    return Criterion(
        letter="e",
        what=f"two simulated people are like real ones: {published.what}",
        figure=found,
        bar=published.interval,
        passed=published.low <= found <= published.high,
        detail=published.source,
    )


def no_free_ride(hold: Run, human_human: Run) -> Criterion:
    """Return whether doing nothing, or dropping the table, costs more than two people do."""
    ratio = mean_mm(hold) / mean_mm(human_human)
    worst = max(each.scores["rmse_mm"] for each in human_human.episodes)
    return Criterion(
        letter="f",
        what="nobody earns by standing still or by dropping the table",
        figure=ratio,
        bar=f"at least {IDLE:g}",
        passed=ratio >= IDLE and worst < FAILED_FRAME_MM,
        detail=f"hold {mean_mm(hold):.1f} mm, two people {mean_mm(human_human):.1f} mm (at most "
        f"{worst:.0f}), a frame after a drop {FAILED_FRAME_MM:.0f} mm",
    )


def mean_mm(run: Run) -> float:
    """Return the mean RMSE of a run [mm]."""
    return float(np.mean([each.scores["rmse_mm"] for each in run.episodes]))


def person_means_mm(played: ScoreTable) -> dict[str, float]:
    """Return the mean RMSE with each person [mm]."""
    people = dict.fromkeys(person for _, person in played.strata)
    return {person: played.part(subject=person).mean for person in people}


def _log_mean(run: Run, person: str, behaviour: str | None = None) -> float:
    return float(
        np.mean(
            [
                np.log(each.scores["rmse_mm"])
                for each in run.episodes
                if each.subject == person and behaviour in (None, each.behaviour)
            ]
        )
    )


def _better_with(one: Run, other: Run) -> tuple[Sequence[str], Sequence[str]]:
    """Return the people with whom each of two policies is better, beyond a 95 % interval."""
    found: tuple[list[str], list[str]] = ([], [])
    pairs = list(zip(one.episodes, other.episodes, strict=True))
    for person in dict.fromkeys(each.subject for each in one.episodes):
        own = [pair for pair in pairs if pair[0].subject == person]
        difference = paired_difference(
            [a.scores["rmse_mm"] for a, _ in own],
            [b.scores["rmse_mm"] for _, b in own],
            Units.episodes(a.behaviour for a, _ in own),
        )
        if difference.ends[1] < 0.0:
            found[0].append(person)
        elif difference.ends[0] > 0.0:
            found[1].append(person)
    return found
