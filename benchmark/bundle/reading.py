"""Strict reading of a bundle from any source."""

import hashlib
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from colift.base.errors import InputError
from colift.benchmark.bundle.arrays import parse_arrays
from colift.benchmark.bundle.files import (
    EPISODES,
    HARDWARE,
    INPUTS,
    LOGS,
    MANIFEST,
    RECORDINGS,
    RESULTS,
    TRACES,
    read_files,
)
from colift.benchmark.bundle.json_text import dump_json, of_type, parse_json, pick
from colift.benchmark.bundle.recipe import FROM_NAMES, Recipe
from colift.benchmark.bundle.table import parse_table, treated
from colift.benchmark.bundle.traces import LARGEST_LIFT, parse_traces
from colift.benchmark.bundle.writing import FORMAT, kept_logs
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import SCORING
from colift.benchmark.execution.runner import Run

LONGEST_LINE: Final = 1000
"""Longest name of a policy, version or isolation level [characters]."""

MOST_COUNTED: Final = 10**6
"""Largest count, such as of faults of the machine."""

MOST_PLATFORM: Final = 100
"""Largest number of entries in a platform's fingerprint."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Bundle:
    """The claims of a bundle: well formed, but not verified."""

    results: dict[str, Any]
    """The content of ``results.json``."""
    episodes: tuple[Episode, ...]
    """The episodes, without step times. If another version of the metrics computed their scores,
    a metric that the version did not have is NaN."""
    indices: tuple[int, ...]
    """The place of each episode in the suite, counted from 0."""
    human_human_mm: tuple[float, ...] | None
    """RMSE of two people on the lift of each episode [mm]; None in a bundle from before it was
    written, or without the human-human baseline."""
    recipe: Recipe
    """The recipe of the suite."""
    platform: dict[str, str]
    """The fingerprint of the platform that simulated the episodes."""

    def run(self) -> Run:
        """Return the run that the bundle claims.

        Raises
        ------
        InputError
            If the suite cannot be made.
        """
        return Run(
            policy=self.results["policy"]["name"],
            policy_digest=self.results["policy"]["digest"],
            suite=self.recipe.suite(),
            episodes=self.episodes,
            isolation=self.results["isolation"],
            faults=self.results["evaluator_faults"],
            channel=self.recipe.channel,
        )


def read_bundle(folder: Path) -> Bundle:
    """Return the claims of the bundle in a folder.

    Raises
    ------
    InputError
        If it is not a bundle, is damaged, or a file's hash differs from the manifest's.
    """
    files = read_files(folder)
    bundle = parse(files)
    for name, reason in wrong_hashes(files):
        raise InputError(f"{name}: {reason}")
    return bundle


def wrong_hashes(files: Mapping[str, bytes]) -> list[tuple[str, str]]:
    """Return each file whose hash differs from the manifest's, with the reason.

    Raises
    ------
    InputError
        If the manifest has no hashes.
    """
    claimed = pick(parse_json(files[MANIFEST], MANIFEST), "sha256", dict, MANIFEST)
    true = {
        name: hashlib.sha256(data).hexdigest() for name, data in files.items() if name != MANIFEST
    }
    wrong = []
    for name in sorted({*true, *claimed}):
        if name not in true:
            wrong.append((MANIFEST, f"it has the SHA-256 of {name!r:.80}, which is not there"))
        elif name not in claimed:
            wrong.append((name, f"{MANIFEST} does not have its SHA-256"))
        elif claimed[name] != true[name]:
            wrong.append((name, f"its SHA-256 is not the one in {MANIFEST}"))
    return wrong


def parse(files: Mapping[str, bytes]) -> Bundle:
    """Return the claims of a bundle's files; their hashes are not checked.

    Raises
    ------
    InputError
        If one is malformed; the message names it and the reason.
    """
    manifest = parse_json(files[MANIFEST], MANIFEST)
    form = pick(manifest, "format", int, MANIFEST)
    if form == FORMAT and [*manifest] != ["format", "platform", "recipe", "sha256"]:
        raise InputError(f"{MANIFEST}: it has other keys than colift writes: {_shown(manifest)}")
    if form != FORMAT:
        raise InputError(f"{MANIFEST}: the bundle has format {form}, must be {FORMAT}")
    if manifest.get("recipe", 0) is None:
        raise InputError(f"{MANIFEST}: there is no recipe, since {_without_recipe(files)}")
    recipe = Recipe.parse(
        pick(manifest, "recipe", dict, MANIFEST), files.get(RECORDINGS), files.get(INPUTS)
    )
    platform = {
        name: _line(value, f"{MANIFEST}: platform.{name!r:.80}")
        for name, value in pick(manifest, "platform", dict, MANIFEST).items()
    }
    if len(platform) > MOST_PLATFORM:
        raise InputError(f"{MANIFEST}: platform has more than {MOST_PLATFORM} entries")
    lifts = len(recipe.scenarios) * len(recipe.seeds)
    traces, indices = parse_traces(parse_arrays(files[TRACES], TRACES, LARGEST_LIFT * lifts))
    if indices[-1] >= lifts:
        raise InputError(f"{TRACES}: the suite has no place {indices[-1]}")
    logs = _logs(files[LOGS], len(traces)) if LOGS in files else [""] * len(traces)
    results = _results(files[RESULTS], acted=any(len(trace.action) for trace in traces))
    outdated = results["scoring"] != SCORING
    played = {} if recipe.recordings is None else treated(recipe.suite())
    episodes, human_human_mm = parse_table(
        files[EPISODES], traces, logs, recipe.metrics(), played, outdated=outdated
    )
    kept = kept_logs(episodes)
    if LOGS in files and (not kept or files[LOGS] != dump_json(kept)):
        raise InputError(f"{LOGS}: must be the end of each failed lift's output, in order")
    return Bundle(
        results=results,
        episodes=episodes,
        indices=indices,
        human_human_mm=human_human_mm,
        recipe=recipe,
        platform=platform,
    )


def _without_recipe(files: Mapping[str, bytes]) -> str:
    """Return the reason why a bundle has no recipe."""
    if HARDWARE in parse_json(files[RESULTS], RESULTS):
        return "trials of a robot cannot be simulated again"
    return f"the suite cannot be made again from names: {FROM_NAMES}"


def _results(data: bytes, *, acted: bool) -> dict[str, Any]:
    """Return ``results.json`` after a check of the parts that no simulation can verify.

    ``acted`` is whether the policy acted in any lift.
    """
    content = parse_json(data, RESULTS)
    for path in ("colift", "suite", "suite_digest", "policy.name", "policy.digest", "isolation"):
        _line(pick(content, path, str, RESULTS), f"{RESULTS}: {path}")
    pick(content, "complete", bool, RESULTS)
    pick(content, "baselines", dict, RESULTS)
    for path in ("scoring", "evaluator_faults"):
        if not 0 <= pick(content, path, int, RESULTS) <= MOST_COUNTED:
            raise InputError(f"{RESULTS}: {path} must be from 0 to {MOST_COUNTED}")
    p50, p99 = (
        pick(content, f"summary.step_ms.{name}", (float, type(None)), RESULTS)
        for name in ("p50", "p99")
    )
    if p50 is None or p99 is None:
        if acted or p50 is not p99:
            raise InputError(f"{RESULTS}: summary.step_ms is missing, but the policy acted")
    elif not (math.copysign(1.0, p50) > 0 and p50 <= p99):
        raise InputError(f"{RESULTS}: summary.step_ms must have 0 <= p50 <= p99, got {p50}, {p99}")
    return content


def _line(value: object, what: str) -> str:
    """Return a text that may be printed on one line."""
    text = of_type(value, str, what)
    if len(text) > LONGEST_LINE or not text.isprintable():
        raise InputError(f"{what} must be at most {LONGEST_LINE} printable characters")
    return text


def _shown(names: Iterable[str]) -> str:
    return f"{', '.join(names)!r:.80}"


def _logs(data: bytes, episodes: int) -> list[str]:
    """Return the policy's output in each episode."""
    content = parse_json(data, LOGS)
    rows = {str(row): "" for row in range(1, episodes + 1)}
    for row, log in content.items():
        if row not in rows:
            raise InputError(f"{LOGS}: there is no episode {row!r:.80}")
        rows[row] = of_type(log, str, f"{LOGS}: {row}")
    return list(rows.values())
