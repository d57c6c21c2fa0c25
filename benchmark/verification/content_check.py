"""Checks of a bundle's claims: its suite, its episodes, and the numbers that follow from them."""

import json
from collections.abc import Iterator
from concurrent.futures import Executor
from typing import Final

from colift.base.errors import InputError
from colift.base.registry import SUITES, entries
from colift.benchmark.bundle import Bundle, Difference, Results, differences, one_line, results
from colift.benchmark.bundle.content import with_circumstances
from colift.benchmark.bundle.files import EPISODES, MANIFEST, RESULTS, TRACES
from colift.benchmark.bundle.table import HUMAN_HUMAN_RMSE
from colift.benchmark.channels import Channel, channel_name
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import SCORING
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.baselines import (
    BASELINES,
    HUMAN_HUMAN,
    play_baselines,
    shipped_baselines,
)
from colift.benchmark.results.lifts import lift_name
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import Suite, make_suite
from colift.benchmark.verification.deviation import REFERENCES, SCORES
from colift.benchmark.verification.verdict import Finding

_FROM_BASELINES: Final = ("baselines", "summary.vs_human", HUMAN_HUMAN_RMSE)


def played_label(suite: Suite, channel: Channel | None) -> str:
    """Return a verified label of a suite and of the channel over which it was played."""
    label = suite_label(suite)
    return label if channel is None else f"{label}, over the channel {channel_name(channel)}"


def suite_label(suite: Suite) -> str:
    """Return a verified label of a suite: the registered name of its digest, or its size.

    The name in a bundle is only a claim of its author.
    """
    digest = suite.digest
    for name in entries(SUITES):
        if _registered(name) == digest:
            return name
    first = suite.scenarios[0]
    known = first.conditions is None
    timing = f"latency {first.latency:g} s" if known else f"conditions {first.conditions}"
    label = f"a suite of its own: {suite.size} lifts, {timing}"
    if first.control_period != CONTROL_PERIOD:
        label += f", control period {first.control_period:g} s"
    return label


def _registered(name: str) -> str | None:
    """Return the digest of a registered suite; None if there is none, or it cannot be made."""
    try:
        return make_suite(name).digest if name in entries(SUITES) else None
    except InputError:
        return None  # Another package is broken, which is not a fault of the bundle.


def suite_findings(bundle: Bundle, suite: Suite) -> Iterator[Finding]:
    """Yield the faults in the claimed name and digest of the suite that the recipe makes."""
    claimed, digest = bundle.results["suite_digest"], suite.digest
    # The digest includes the constants of the metrics, which older scores may not share.
    if claimed != digest and bundle.results["scoring"] == SCORING:
        message = (
            f"suite_digest is {claimed!r:.80}, but {MANIFEST} makes a suite of digest {digest!r}: "
            "other episodes, or the benchmark's rules have changed since"
        )
        yield Finding(file=RESULTS, message=message)
    if bundle.results["suite"] != suite.name:
        message = f"suite is {bundle.results['suite']!r:.80}, in {MANIFEST} {suite.name!r:.80}"
        yield Finding(file=RESULTS, message=message)
    if _registered(suite.name) not in (None, digest):
        message = f"the suite has the name {suite.name}, but other episodes"
        yield Finding(file=MANIFEST, message=message)


def episode_findings(bundle: Bundle, suite: Suite) -> Iterator[Finding]:
    """Yield the first episode that is not the suite's at its place, and the first missing one.

    An incomplete run is a fault in any case: there is no score on part of a suite.
    """
    names = [
        one_line(lift_name(scene.behaviour, scene.subject.name, scene.trial, seed))
        for scene in suite.scenarios
        for seed in suite.seeds
    ]
    for row, (index, episode) in enumerate(zip(bundle.indices, bundle.episodes, strict=True), 1):
        found = episode_name(episode)
        if found != names[index]:
            message = f"row {row} is {found} instead"
            yield Finding(file=EPISODES, episode=names[index], message=message)
            break
    missing = sorted({*range(suite.size)} - {*bundle.indices})
    if missing:
        message = (
            f"missing, one of {len(missing)} of {suite.size} episodes: part of a suite has no "
            "score; resume the run to finish it"
        )
        yield Finding(file=TRACES, episode=names[missing[0]], message=message)


def episode_name(episode: Episode) -> str:
    """Return the name of an episode, such as ``pause/S3 seed 4``."""
    return one_line(lift_name(episode.behaviour, episode.subject, episode.trial, episode.seed))


def rebuilt(bundle: Bundle, run: Run, executor: Executor | None) -> Results:
    """Return the results that follow from a run.

    Claims that no simulation can verify are taken from the bundle, as is the choice of baselines.

    Raises
    ------
    InputError
        If the bundle names an unknown baseline.
    """
    content = results(run, _baselines(bundle, run, executor))
    return with_circumstances(content, bundle.results, run.suite)


def _baselines(bundle: Bundle, run: Run, executor: Executor | None) -> dict[str, ScoreTable]:
    wanted = bundle.results["baselines"]
    if not wanted:
        return {}
    for name in wanted:
        if name not in BASELINES:
            raise InputError(f"{RESULTS}: there is no baseline {name!r:.80}")
    known = shipped_baselines(run.suite) or play_baselines(run.suite, executor=executor)
    return {name: known[name] for name in wanted}


def score_findings(bundle: Bundle, run: Run, content: Results, *, exact: bool) -> Iterator[Finding]:
    """Yield every wrong score of an episode and every wrong number of the summary.

    Parameters
    ----------
    bundle
        The claims.
    run, content
        The episodes that follow from the actions, and their results by :func:`rebuilt`.
    exact
        Whether equal bits are demanded; else :data:`.SCORES` holds, and :data:`.REFERENCES` for
        baselines that are not shipped.
    """
    tolerance = 0.0 if exact else SCORES
    played = not exact and shipped_baselines(run.suite) is None
    people = content.baselines.get(HUMAN_HUMAN)
    if bundle.human_human_mm is not None and people is None:
        message = f"{HUMAN_HUMAN_RMSE} is there, but {RESULTS} has no {HUMAN_HUMAN}"
        yield Finding(file=EPISODES, message=message)
    for row, (claim, true) in enumerate(zip(bundle.episodes, run.episodes, strict=True)):
        scores = [dict(each.scores) for each in (claim, true)]
        if bundle.human_human_mm is not None and people is not None:
            scores[0][HUMAN_HUMAN_RMSE] = bundle.human_human_mm[row]
            scores[1][HUMAN_HUMAN_RMSE] = people.lifts_mm[bundle.indices[row]]
        for difference in differences(*scores, tolerance=tolerance):
            if not (played and _near(difference)):
                yield Finding(file=EPISODES, episode=episode_name(true), message=str(difference))
    plain = json.loads(json.dumps(content.plain()))
    for difference in differences(bundle.results, plain, tolerance=tolerance):
        if not (played and _near(difference)):
            yield Finding(file=RESULTS, message=str(difference))


def _near(difference: Difference) -> bool:
    """Return whether a number that depends on baselines is within its tolerance."""
    if not any(name in difference.path for name in _FROM_BASELINES):
        return False
    return not [*differences(difference.claimed, difference.true, tolerance=REFERENCES)]
