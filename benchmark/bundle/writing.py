"""Writing of bundles."""

import hashlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from colift.benchmark.bundle.arrays import write_arrays
from colift.benchmark.bundle.files import (
    EPISODES,
    INPUTS,
    LARGEST,
    LOGS,
    MANIFEST,
    RECORDINGS,
    RESULTS,
    TRACES,
    replaced_folder,
)
from colift.benchmark.bundle.json_text import dump_json
from colift.benchmark.bundle.recipe import Recipe
from colift.benchmark.bundle.table import dump_table, treated
from colift.benchmark.bundle.traces import trace_arrays
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.provenance import fingerprint
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.scores import ScoreTable

FORMAT: Final = 1
"""Number of the bundle's format."""

LONGEST_LOG: Final = 10_000
"""Kept part of a failed episode's output [characters], from the end."""

MOST_LOGS: Final = 100
"""Number of failed episodes whose output is kept, from the first."""


def write_bundle(
    folder: Path,
    run: Run,
    content: Mapping[str, Any],
    *,
    human_human: ScoreTable | None = None,
    platform: Mapping[str, str] | None = None,
) -> None:
    """Write the bundle of a run: everything, or nothing.

    Equal runs give equal files, bit for bit, except for the step times in ``results.json`` and,
    therefore, its hash in the manifest.

    Parameters
    ----------
    folder
        The folder to write; an older bundle there is replaced.
    run
        The episodes, at least one.
    content
        The content of ``results.json``; see :meth:`.Results.plain`.
    human_human
        The human-human baseline on the same episodes, if it is known.
    platform
        The fingerprint of the platform that simulated the episodes, if it is not this one.

    Raises
    ------
    InputError
        As :func:`.check_bundle_folder`.
    """
    recipe = Recipe.of(run.suite, run.channel)
    files = {
        RESULTS: dump_json(content),
        EPISODES: dump_table(
            run.episodes,
            run.suite.metrics,
            treated(run.suite),
            None if human_human is None else human_human.lifts_at(run.places),
        ),
    }
    if recipe is not None and recipe.recordings is not None:
        files[RECORDINGS] = recipe.recordings
    if recipe is not None and recipe.inputs is not None:
        files[INPUTS] = recipe.inputs
    logs = kept_logs(run.episodes)
    if logs:
        files[LOGS] = dump_json(logs)
    with replaced_folder(folder) as made:
        for name, data in files.items():
            (made / name).write_bytes(data)
        with (made / TRACES).open("w+b") as file:
            traces = trace_arrays(lambda: (each.trace for each in run.episodes), run.places)
            write_arrays(file, traces)
        manifest = {
            "format": FORMAT,
            "platform": dict(platform or fingerprint()),
            "recipe": None if recipe is None else recipe.plain(),
            "sha256": {name: _sha256(made / name) for name in LARGEST if (made / name).exists()},
        }
        (made / MANIFEST).write_bytes(dump_json(manifest))


def _sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def kept_logs(episodes: Sequence[Episode]) -> dict[str, str]:
    """Return the output of failed policies, by the row of ``episodes.csv``, from 1."""
    failed = [
        (row, episode.log)
        for row, episode in enumerate(episodes, 1)
        if episode.failure is not None and episode.log
    ]
    return {str(row): log[-LONGEST_LOG:] for row, log in failed[:MOST_LOGS]}
