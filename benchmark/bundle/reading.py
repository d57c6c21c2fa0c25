"""Reading a bundle, whoever wrote it."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...agents.errors import InputError
from ..episode import Episode
from ..runner import Run
from .arrays import parse_arrays
from .files import EPISODES, LOGS, MANIFEST, RECORDINGS, RESULTS, TRACES, read_files
from .json_text import checked, parse_json, pick
from .recipe import Recipe
from .table import parse_table
from .traces import parse_traces
from .writing import FORMAT


@dataclass(frozen=True, kw_only=True, eq=False)
class Bundle:
    """What a bundle says. It is well formed; whether it is true is for a verification."""

    results: dict[str, Any]
    """The content of ``results.json``."""
    episodes: tuple[Episode, ...]
    """The episodes, without step times."""
    places: tuple[int, ...]
    """Where in the suite each episode is, counted from 0."""
    recipe: Recipe
    """What re-makes the suite."""
    platform: dict[str, str]
    """The fingerprint of the platform that simulated the episodes."""

    def run(self) -> Run:
        """Return the run that the bundle claims to be of.

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
        )


def read_bundle(folder: Path) -> Bundle:
    """Return what the bundle in a folder says.

    Raises
    ------
    InputError
        If it is not a bundle, damaged, or a file's hash is not the one in the manifest.
    """
    files = read_files(folder)
    bundle = parse(files)
    for name, reason in wrong_hashes(files):
        raise InputError(f"{name}: {reason}")
    return bundle


def wrong_hashes(files: Mapping[str, bytes]) -> list[tuple[str, str]]:
    """Return each file whose hash is not as the manifest has it, with the reason.

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
    """Return what files say, without a look at their hashes.

    Raises
    ------
    InputError
        If one is not what it must be; the message says which and why.
    """
    manifest = parse_json(files[MANIFEST], MANIFEST)
    form = pick(manifest, "format", int, MANIFEST)
    if form != FORMAT:
        raise InputError(f"{MANIFEST}: the bundle has format {form}, must be {FORMAT}")
    if manifest.get("recipe", 0) is None:
        raise InputError(
            f"{MANIFEST}: there is no recipe: the suite cannot be made again from names, since "
            "its behaviours or subjects are not registered ones with their own parameters"
        )
    recipe = Recipe.parse(pick(manifest, "recipe", dict, MANIFEST), files.get(RECORDINGS))
    platform = {
        name: checked(value, str, f"{MANIFEST}: platform.{name!r:.80}")
        for name, value in pick(manifest, "platform", dict, MANIFEST).items()
    }
    traces, places = parse_traces(parse_arrays(files[TRACES], TRACES))
    if places[-1] >= len(recipe.scenarios) * len(recipe.seeds):
        raise InputError(f"{TRACES}: the suite has no place {places[-1]}")
    logs = _logs(files[LOGS], len(traces)) if LOGS in files else [""] * len(traces)
    return Bundle(
        results=_results(files[RESULTS]),
        episodes=parse_table(files[EPISODES], traces, logs),
        places=places,
        recipe=recipe,
        platform=platform,
    )


def _results(data: bytes) -> dict[str, Any]:
    """Return ``results.json``, with that checked which no simulation can tell."""
    content = parse_json(data, RESULTS)
    for path in ("colift", "suite", "suite_digest", "policy.name", "policy.digest", "isolation"):
        pick(content, path, str, RESULTS)
    pick(content, "scoring", int, RESULTS)
    pick(content, "complete", bool, RESULTS)
    pick(content, "references", dict, RESULTS)
    if pick(content, "evaluator_faults", int, RESULTS) < 0:
        raise InputError(f"{RESULTS}: evaluator_faults must not be negative")
    for path in ("summary.step_ms.p50", "summary.step_ms.p99"):
        time = pick(content, path, (float, type(None)), RESULTS)
        if time is not None and time < 0:
            raise InputError(f"{RESULTS}: {path} must not be negative")
    return content


def _logs(data: bytes, episodes: int) -> list[str]:
    """Return what the policy had printed in each episode."""
    content = parse_json(data, LOGS)
    rows = {str(row): "" for row in range(1, episodes + 1)}
    for row, log in content.items():
        if row not in rows:
            raise InputError(f"{LOGS}: there is no episode {row!r:.80}")
        rows[row] = checked(log, str, f"{LOGS}: {row}")
    return list(rows.values())
