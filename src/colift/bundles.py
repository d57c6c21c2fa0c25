"""``colift.load`` and ``colift.inspect``: from a result bundle to its scores and their reasons."""

from contextlib import nullcontext
from pathlib import Path

from colift.base.errors import InputError
from colift.benchmark.bundle.present import read_results
from colift.benchmark.execution.pool import local_pool
from colift.benchmark.execution.progress import progress_bar
from colift.benchmark.inspection import WORST
from colift.benchmark.inspection.inspection import Inspection, inspect_run
from colift.outcome import Evaluation

__all__ = ["Inspection", "inspect", "load"]


def load(folder: str | Path, *, jobs: int = 1) -> Evaluation:
    """Return the evaluation in a result bundle, as :func:`.evaluate` returned it.

    Parameters
    ----------
    folder
        A bundle of ``colift run --out`` or of a board. Its scores are claims, as is every number
        that follows from them: ``colift verify`` simulates its lifts again.
    jobs
        Number of worker processes for the baselines, which are played again unless colift ships
        those of the suite.

    Returns
    -------
    Evaluation
        That of an interrupted run has the lifts that were finished.

    Raises
    ------
    InputError
        If it is no bundle or damaged, or its suite or scores are not those of this version.
    EvaluatorFault, KeyboardInterrupt
        As :func:`.evaluate`.
    """
    with local_pool(jobs) as pool:
        run, results = read_results(Path(folder), executor=pool)
    return Evaluation(run=run, results=results)


def inspect(
    evaluation: Evaluation | str | Path,
    *,
    worst: int = WORST,
    jobs: int = 1,
    progress: bool = False,
) -> Inspection:
    """Return the reasons of a score: worst lifts and moments, strengths and weaknesses.

    Everything is beside two people, who play each lift here: this takes about as long as the
    evaluation of a policy.

    Parameters
    ----------
    evaluation
        What :func:`.evaluate` or :func:`load` returned, or the folder of a result bundle.
    worst
        Number of lifts with the largest error.
    jobs
        Number of worker processes; with 1 all lifts are played in this process.
    progress
        Whether to show a bar on a terminal's stderr.

    Returns
    -------
    Inspection
        ``print`` shows it as ``colift inspect`` does, :meth:`.Inspection.page` is its page, and its
        attributes are the numbers.

    Raises
    ------
    InputError
        If ``worst`` is below 1, or as :func:`load`.
    EvaluatorFault, KeyboardInterrupt
        As :func:`.evaluate`.
    """
    folder = Path(evaluation) if isinstance(evaluation, str | Path) else None
    given = load(folder, jobs=jobs) if folder is not None else evaluation
    if not isinstance(given, Evaluation):
        raise InputError(
            f"{given!r:.80} is no evaluation: give what colift.evaluate or colift.load returns, or "
            "the folder of a result bundle"
        )
    total = len(given.run.episodes)
    bar = progress_bar("two people", total) if progress else nullcontext(lambda done: None)
    with local_pool(jobs) as pool, bar as advance:
        return inspect_run(
            given.run,
            given.results,
            worst=worst,
            folder=folder,
            executor=pool,
            progress=advance,
        )
