"""Bundles whose scores are those of this version of colift."""

from pathlib import Path

from colift.base.errors import InputError, Remedy
from colift.benchmark.bundle.reading import Bundle, read_bundle
from colift.benchmark.episode.metric import SCORING
from colift.benchmark.execution.runner import Run


def read_present(folder: Path) -> tuple[Bundle, Run]:
    """Return the claims of the bundle in a folder, and the run that they are of.

    Raises
    ------
    InputError
        If there is no bundle, it is damaged, or its suite or its scores are not those of this
        version of colift.
    """
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder; name that of a result bundle")
    try:
        bundle = read_bundle(folder)
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
