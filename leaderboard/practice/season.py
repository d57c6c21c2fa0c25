"""The practice season: a season with a public secret and rows of the built-in policies.

Its rows are evaluated like submissions. But its secret follows from this file, so its hidden
episodes prove nothing: the season fills a new board, and is for trying a submission. A competitive
season has a random secret; see :meth:`.Board.new_season`.
"""

import hashlib
import json
import tempfile
from concurrent.futures import Executor
from datetime import datetime
from pathlib import Path
from typing import Final

from colift.agents.sandbox.host.levels import choose
from colift.base.errors import EvaluatorFault
from colift.base.registry import LEADING_SUITES
from colift.benchmark.bundle import read_bundle
from colift.benchmark.bundle.files import EPISODES, RESULTS
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.core.board import BUILTIN
from colift.leaderboard.evaluation.entrant import builtin_entrant
from colift.leaderboard.evaluation.evaluate import evaluate_entrant, versions
from colift.leaderboard.evaluation.progress import Callbacks
from colift.leaderboard.records.season import BoardEntry, PlayedEntry, Season
from colift.leaderboard.replays.chosen import FILE, chosen_replays

SUITES: Final = (*LEADING_SUITES, "session-v1", "paper-v1", "intent-v1", "agree-v1", "ball-v1")
"""The suites that have a practice season, in the order in which a new board shows them.

Its rows are the policies that are made for the suite's task: the others fail most of its lifts.
"""


def practice_season(suite: str) -> Season:
    """Return the practice season on a suite: its name and its secret follow from the suite's.

    secret = SHA-256("colift practice season on SUITE")
    """
    made = make_suite(suite)
    secret = hashlib.sha256(f"colift practice season on {suite}".encode()).digest()
    return Season(name=f"practice-{suite}", suite=made, secret=secret)


def play_policy(
    name: str,
    season: Season,
    human_human: ScoreTable,
    at: datetime,
    *,
    executor: Executor | None = None,
    watch: Callbacks | None = None,
) -> PlayedEntry:
    """Evaluate a built-in policy like a submission.

    Parameters
    ----------
    name
        The policy.
    season, human_human, executor, watch
        As for :func:`.evaluate_entrant`.
    at
        The present time.

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
        evaluation = evaluate_entrant(
            entrant, season, human_human, folder, executor=executor, watch=watch
        )
        if evaluation.row is None:
            raise EvaluatorFault(f"{name} is refused: {evaluation.refusal}")
        replays = {"replays": chosen_replays(read_bundle(folder), name)}
        files = {each: (folder / each).read_bytes() for each in (RESULTS, EPISODES)}
    entry = BoardEntry(
        season=season.name,
        submission=entrant.digest,
        name=name,
        submitter=BUILTIN,
        at=at,
        row=evaluation.row,
        refusal=None,
    )
    return PlayedEntry(
        entry=entry,
        hidden_rmse_mm=evaluation.hidden_rmse_mm,
        files={**files, FILE: json.dumps(replays, separators=(",", ":")).encode()},
    )


def is_current(played: PlayedEntry, season: Season) -> bool:
    """Return whether policy, suite and versions are still those of an evaluation."""
    row = played.entry.row
    return (
        row is not None
        and (row.suite_digest, row.commitment) == (season.suite.digest, season.commitment)
        and row.submission == builtin_entrant(played.entry.name).digest
        and dict(row.versions) == versions()
    )
