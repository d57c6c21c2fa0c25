"""Bundles whose scores are those of this version of colift."""

from collections.abc import Callable
from concurrent.futures import Executor
from pathlib import Path

from colift.base.errors import InputError, Remedy
from colift.benchmark.bundle.content import Results, results, with_circumstances
from colift.benchmark.bundle.files import RESULTS, is_bundle
from colift.benchmark.bundle.reading import Bundle, read_bundle
from colift.benchmark.episode.metric import SCORING
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.baselines import play_baselines, shipped_baselines


def read_claims(folder: Path) -> Bundle:
    """Return the claims of the bundle in a folder.

    Raises
    ------
    InputError
        If there is no bundle, or it is damaged; it names the folder.
    """
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder; name that of a result bundle")
    if not is_bundle(folder):
        raise InputError(f"{folder} has no {RESULTS}: name the folder of a result bundle")
    try:
        return read_bundle(folder)
    except InputError as error:
        raise InputError(f"{folder}: {error}") from error


def read_present(folder: Path) -> tuple[Bundle, Run]:
    """Return the claims of the bundle in a folder, and the run that they are of.

    Raises
    ------
    InputError
        If there is no bundle, it is damaged, or its suite or its scores are not those of this
        version of colift.
    """
    bundle = read_claims(folder)
    try:
        run = bundle.run()
    except InputError as error:
        raise InputError(f"{folder}: {error}") from error
    content = bundle.results
    scoring = content["scoring"]
    if scoring != SCORING:
        fault = f"{folder} has scores of version {scoring}, this colift computes version {SCORING}"
        if scoring > SCORING:
            raise InputError(f"{fault}: read it with a newer colift")
        raise InputError(fault, remedy=Remedy.RESCORE, target=str(folder))
    if content["suite_digest"] != run.suite.digest:
        raise InputError(
            f"{folder} was played on {content['suite']} with digest {content['suite_digest']}; "
            f"here that suite has digest {run.suite.digest}: run the policy again"
        )
    return bundle, run


def read_results(
    folder: Path,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> tuple[Run, Results]:
    """Return the run that a bundle claims, and its results, as they were when it was played.

    They follow from the claimed scores of the lifts, and have the baselines on these lifts even if
    the run was interrupted. Baselines that are not shipped are played again.

    Parameters
    ----------
    folder
        The bundle.
    executor, progress
        As for :func:`.play_baselines`.

    Raises
    ------
    InputError
        As :func:`read_present`.
    EvaluatorFault, KeyboardInterrupt
        As :func:`.run_suite`.
    """
    bundle, run = read_present(folder)
    baselines = shipped_baselines(run.suite) or play_baselines(
        run.suite, executor=executor, progress=progress
    )
    if not run.complete:
        baselines = {name: each.select(bundle.indices) for name, each in baselines.items()}
    return run, with_circumstances(results(run, baselines), bundle.results, run.suite)
