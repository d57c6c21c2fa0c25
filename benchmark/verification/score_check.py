"""The check of the numbers: each must be what follows from the episodes."""

import dataclasses
import json
from collections.abc import Iterator
from concurrent.futures import Executor
from typing import Any, Final

from ...agents.errors import InputError
from ..bundle import Bundle, Difference, differences, results
from ..bundle.content import with_circumstances
from ..bundle.files import EPISODES, RESULTS
from ..references import SPECS, Reference, play_references, shipped_references
from ..runner import Run
from .suite_check import episode_name
from .tolerance import REFERENCES, SCORES
from .verdict import Finding

_FROM_REFERENCES: Final = ("references", "summary.vs_human", "human_human_rmse_mm")


def rebuilt(bundle: Bundle, run: Run, executor: Executor | None) -> dict[str, Any]:
    """Return what ``results.json`` should say of a run.

    What no simulation can tell is as the bundle has it; so is which references there are.

    Raises
    ------
    InputError
        If the bundle names an unknown reference.
    """
    content = results(run, _references(bundle, run, executor))
    content = with_circumstances(content, bundle.results, run.suite)
    plain: dict[str, Any] = json.loads(json.dumps(content))
    return plain


def _references(bundle: Bundle, run: Run, executor: Executor | None) -> dict[str, Reference]:
    wanted = bundle.results["references"]
    if not wanted:
        return {}
    for name in wanted:
        if name not in SPECS:
            raise InputError(f"{RESULTS}: there is no reference {name!r:.80}")
    known = shipped_references(run.suite) or play_references(run.suite, executor=executor)
    return {name: known[name] for name in wanted}


def score_findings(
    bundle: Bundle, run: Run, content: dict[str, Any], *, same_platform: bool
) -> Iterator[Finding]:
    """Yield every score of an episode and every number of the summary that is not what it should.

    Parameters
    ----------
    bundle
        What is claimed.
    run, content
        What follows from the actions: the episodes, and :func:`rebuilt`.
    same_platform
        Whether equal bits are demanded; else :data:`.SCORES` and :data:`.REFERENCES` hold.
    """
    tolerance = 0.0 if same_platform else SCORES
    for claim, true in zip(bundle.episodes, run.episodes, strict=True):
        scores = (dataclasses.asdict(each.scores) for each in (claim, true))
        for difference in differences(*scores, tolerance=tolerance):
            yield Finding(file=EPISODES, episode=episode_name(true), message=str(difference))
    for difference in differences(bundle.results, content, tolerance=tolerance):
        if same_platform or not _near(difference):
            yield Finding(file=RESULTS, message=str(difference))


def _near(difference: Difference) -> bool:
    """Return whether a number that follows from the references is near enough."""
    if not any(name in difference.path for name in _FROM_REFERENCES):
        return False
    return not [*differences(difference.claimed, difference.true, tolerance=REFERENCES)]
