"""Verification of a bundle: from a folder to a verdict."""

import dataclasses
import itertools
from collections.abc import Callable, Collection, Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import Final

from colift.base.errors import InputError
from colift.benchmark.bundle import Bundle, Results, one_line, parse, read_files
from colift.benchmark.bundle.files import LARGEST
from colift.benchmark.bundle.reading import wrong_hashes
from colift.benchmark.episode.metric import SCORING
from colift.benchmark.execution.provenance import POLICIES_ONLY, fingerprint
from colift.benchmark.execution.runner import Run
from colift.benchmark.verification.content_check import (
    episode_findings,
    played_label,
    rebuilt,
    score_findings,
    suite_findings,
)
from colift.benchmark.verification.deviation import HEIGHT
from colift.benchmark.verification.episode_check import Checked, simulate
from colift.benchmark.verification.verdict import Finding, Verdict

MOST_FINDINGS: Final = 20
"""Largest number of findings in a verdict."""


def verify(
    folder: Path,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Verdict:
    """Return whether a bundle's scores follow from the actions in it.

    Every file's hash is checked, the suite is made again from its recipe, every episode is
    simulated again (:func:`.replay`) and scored again, and every number is compared. Every bit must
    be equal; a tolerance applies only to lifts from another platform.
    Baselines that are not shipped are played again.

    Parameters
    ----------
    folder
        The bundle. Nothing in it is trusted.
    executor
        Simulates the episodes; None simulates them in this process.
    progress
        Called with the number of episodes that were simulated since the last call.

    Returns
    -------
    Verdict
        The outcome with its reasons; a bundle that cannot be read is not verified.

    Raises
    ------
    InputError
        If there is no such folder, or the task or a behaviour of another package failed.
    EvaluatorFault
        If a worker died.
    """
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder; name that of a result bundle")
    findings: list[Finding] = []
    try:
        files = read_files(folder)
        findings += [Finding(file=name, message=reason) for name, reason in wrong_hashes(files)]
        bundle = parse(files)
        run = bundle.run()
        findings += [*suite_findings(bundle, run.suite), *episode_findings(bundle, run.suite)]
    except InputError as error:
        return Verdict(findings=(*findings[: MOST_FINDINGS - 1], _malformed(error)))
    other = other_platform(bundle)
    same_platform = is_same(other)
    checked = simulate(
        bundle, run.suite, same_platform=same_platform, executor=executor, progress=progress
    )
    findings += [each.finding for each in checked if each.finding is not None]
    bit_equal = all(each.bit_equal for each in checked)
    scored = _rescored(run, checked)
    content: Results | None = None
    outdated = bundle.results["scoring"] != SCORING
    if scored is not None:
        try:
            content = rebuilt(bundle, scored, executor)
        except InputError as error:
            findings.append(_malformed(error))
        else:
            if not outdated:
                exact = same_platform or bit_equal
                wrong = score_findings(bundle, scored, content, exact=exact)
                findings += itertools.islice(wrong, MOST_FINDINGS)
    return Verdict(
        findings=tuple(findings[:MOST_FINDINGS]),
        run=scored,
        suite=played_label(run.suite, run.channel),
        results=content,
        bit_equal=bit_equal,
        tolerance_mm=None if same_platform or bit_equal else 1000 * HEIGHT,
        platform=bundle.platform,
        other_platform=other,
        scoring=(bundle.results["scoring"], SCORING) if outdated else None,
    )


def _malformed(error: InputError) -> Finding:
    """Return an error of a bundle's reader as a finding; most have the form ``file: reason``."""
    text = one_line(str(error))
    file, _, message = text.partition(": ")
    known = file.partition(",")[0] in LARGEST
    return Finding(file=file, message=message) if known else Finding(file="bundle", message=text)


def is_same(other: Collection[str]) -> bool:
    """Return whether lifts are equal to the bit on platforms with these differences."""
    return set(other) <= set(POLICIES_ONLY)


def other_platform(bundle: Bundle) -> dict[str, tuple[str, str]]:
    """Return the differences of the platforms by name: the bundle's entry, and the one here."""
    there, here = bundle.platform, fingerprint()
    return {
        name: (there.get(name, "unknown"), here.get(name, "unknown"))
        for name in {**here, **there}
        if there.get(name) != here.get(name)
    }


def _rescored(run: Run, checked: Sequence[Checked]) -> Run | None:
    """Return the run with the scores that follow from its actions; None if a replay failed."""
    episodes = []
    for episode, each in zip(run.episodes, checked, strict=True):
        if each.scores is None:
            return None
        episodes.append(dataclasses.replace(episode, scores=each.scores, failure=each.failure))
    return dataclasses.replace(run, episodes=tuple(episodes))
