"""The practice season: a season whose secret everybody knows, with the project's policies in it.

Its rows are made as anybody's. But whoever reads this file can play its hidden episodes, so that
they test nobody: it is there to see a full board at once, and to try a submission on it. A season
that is to be won begins with a secret of its own; see :meth:`.Board.new_season`.
"""

import hashlib
import json
import tempfile
from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Final

from ...agents.errors import EvaluatorFault
from ...agents.sandbox.host.levels import choose
from ...benchmark.bundle import read_bundle
from ...benchmark.bundle.files import EPISODES, RESULTS
from ...benchmark.results.baselines import Baseline
from ...benchmark.suites.suite import make_suite
from ..board.board import OWN
from ..evaluation.entrant import builtin_entrant
from ..evaluation.evaluation import evaluate_entrant, versions
from ..evaluation.progress import Callbacks
from ..records.season import BoardEntry, Season
from ..replays.chosen import FILE, chosen_replays

NAME: Final = "practice"
"""Name of the season on the standard suite; others add that of their suite."""

STANDARD: Final = "standard-v1"

SUITES: Final = (STANDARD, "paper-v1")
"""The suites on which the project ships a practice season."""


@dataclass(frozen=True, kw_only=True)
class Played:
    """What is shipped of a policy."""

    entry: BoardEntry
    hidden_rmse_mm: tuple[float, ...] = field(repr=False)
    """RMSE of each hidden episode: the ranks follow from it."""
    files: Mapping[str, bytes] = field(repr=False)
    """Of the public run what pages show, by name: the bundle without its traces, and replays."""


def practice_season(suite: str) -> Season:
    """Return the practice season on a suite; its secret follows from the suite's name.

    secret = SHA-256("colift practice season on SUITE")
    """
    made = make_suite(suite)
    secret = hashlib.sha256(f"colift practice season on {suite}".encode()).digest()
    name = NAME if suite == STANDARD else f"{NAME}-{suite}"
    return Season(name=name, suite=made, secret=secret)


def play_policy(
    name: str,
    season: Season,
    team: Baseline,
    at: datetime,
    *,
    executor: Executor | None = None,
    watch: Callbacks | None = None,
) -> Played:
    """Evaluate one of the project's policies, by the very function that evaluates submissions.

    Parameters
    ----------
    name
        The policy.
    season, team, executor, watch
        As for :func:`.evaluate_entrant`.
    at
        What time it is.

    Raises
    ------
    EvaluatorFault
        If the machine failed, or the audit refuses the policy.
    KeyboardInterrupt
        After Ctrl-C.
    """
    entrant = builtin_entrant(name, choose(verifiable=True).level)
    with tempfile.TemporaryDirectory(prefix="colift-") as temporary:
        folder = Path(temporary, "bundle")
        evaluation = evaluate_entrant(entrant, season, team, folder, executor=executor, watch=watch)
        if evaluation.row is None:
            raise EvaluatorFault(f"{name} is refused: {evaluation.refusal}")
        replays = {"replays": chosen_replays(read_bundle(folder), name)}
        files = {each: (folder / each).read_bytes() for each in (RESULTS, EPISODES)}
    entry = BoardEntry(
        season=season.name,
        submission=entrant.digest,
        name=name,
        submitter=OWN,
        at=at,
        row=evaluation.row,
        refusal=None,
    )
    return Played(
        entry=entry,
        hidden_rmse_mm=evaluation.hidden_rmse_mm,
        files={**files, FILE: json.dumps(replays, separators=(",", ":")).encode()},
    )


def is_current(played: Played, season: Season) -> bool:
    """Return whether an evaluation would say the same today: of policy, suite and versions."""
    row = played.entry.row
    return (
        row is not None
        and (row.suite_digest, row.commitment) == (season.suite.digest, season.commitment)
        and row.submission == builtin_entrant(played.entry.name).digest
        and dict(row.versions) == versions()
    )
