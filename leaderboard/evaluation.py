"""From a submission and a season's secret to a row: the same wherever and whenever it is made."""

import dataclasses
from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Final, Literal

from ..agents.errors import EvaluatorFault
from ..agents.isolation.ladder import VERIFIABLE, strongest
from ..agents.submissions.submission import Submission
from ..benchmark.agent_spec import AgentSpec
from ..benchmark.audit import audit, audited
from ..benchmark.bundle import results, write_bundle
from ..benchmark.comparison.standing import Estimate
from ..benchmark.references import (
    SPECS,
    Reference,
    human_team_run,
    play_references,
    shipped_references,
)
from ..benchmark.runner import Run, run_suite
from ..benchmark.scores import SCORING
from ..benchmark.verification import verify
from .row import HiddenScores, PublicScores, Row
from .scoring import gap, hidden_scores, public_scores
from .season import Season

Stage = Literal["public run", "audit", "hidden run", "human-human team", "verification"]

LIBRARIES: Final = ("colift", "numpy", "pybullet")
"""Packages whose version can change a number."""


@dataclass(frozen=True, kw_only=True)
class Entrant:
    """Who is evaluated."""

    name: str
    authors: tuple[str, ...]
    description: str
    link: str
    digest: str
    """Of all that was submitted."""
    policy: AgentSpec
    fresh: AgentSpec
    """The same, in a fresh process for every episode, nothing loaded beforehand: for the audit."""

    @classmethod
    def of(cls, submission: Submission) -> "Entrant":
        """Return a submission as an entrant, as isolated as this machine can."""
        # The rung is named, so that every worker uses it, or fails.
        manifest, policy = submission.manifest, submission.sandboxed(strongest())
        return cls(
            name=manifest.name,
            authors=manifest.authors,
            description=manifest.description,
            link=manifest.link,
            digest=submission.contents.digest,
            policy=policy,
            fresh=dataclasses.replace(policy, preload=False),
        )


@dataclass(frozen=True, kw_only=True)
class Evaluation:
    """What an evaluation has come to: a row, or why there is none."""

    row: Row | None
    refusal: str | None
    hidden_rmse_mm: tuple[float, ...] = dataclasses.field(default=(), repr=False)
    """RMSE of each hidden episode, for the ranks. Never published."""


@dataclass(frozen=True, kw_only=True)
class Watch:
    """Whom an evaluation tells how far it is; every call is also a sign of life."""

    stage: Callable[[Stage], None] = lambda stage: None
    """Called with what begins."""
    progress: Callable[[int], None] = lambda episodes: None
    """Called with the number of episodes that were finished since the last call; see
    :func:`amount`."""
    total: Callable[[int], None] = lambda episodes: None
    """Called with the number of episodes in all, by who knows it."""


def evaluate(
    entrant: Entrant,
    season: Season,
    team: Reference,
    bundle: Path,
    *,
    executor: Executor | None = None,
    watch: Watch | None = None,
) -> Evaluation:
    """Evaluate a submission: public run, hidden run, audit of both, verification.

    It depends on its arguments alone and keeps nothing, so that who was interrupted may begin anew.

    Parameters
    ----------
    entrant
        Who is evaluated.
    season
        Suite and secret.
    team
        The human-human team on the hidden episodes; see :func:`play_team`.
    bundle
        Where the bundle of the public run is written.
    executor
        Runs the episodes; None runs all in this process.
    watch
        Whom to tell how far it is.

    Returns
    -------
    Evaluation
        The row; or the refusal, if the audit found that episodes cannot be repeated.

    Raises
    ------
    InputError
        If the policy cannot be loaded at all.
    EvaluatorFault
        If the machine failed: the submission is not to blame, and is evaluated again.
    KeyboardInterrupt
        After Ctrl-C: there are no partial rows.
    """
    watch = watch or Watch()
    watch.stage("public run")
    public = _complete(
        run_suite(entrant.policy, season.suite, executor=executor, progress=watch.progress)
    )
    references = _references(season, executor, watch)
    content = results(public, references)
    write_bundle(bundle, public, content)
    watch.stage("audit")
    finding = audit(
        entrant.fresh, public, season.secret, executor=executor, progress=watch.progress
    )
    if finding is not None:
        return Evaluation(row=None, refusal=finding.told(public))
    watch.stage("hidden run")
    key = season.policy_key
    hidden = _complete(
        run_suite(
            entrant.policy, season.hidden, executor=executor, progress=watch.progress, key=key
        )
    )
    watch.stage("audit")
    finding = audit(
        entrant.fresh, hidden, season.secret, key=key, executor=executor, progress=watch.progress
    )
    if finding is not None:
        return Evaluation(
            row=None, refusal=f"played again, a hidden episode differs: {finding.reason}"
        )
    watch.stage("verification")
    _verify(bundle, executor, watch)
    return Evaluation(
        row=_row(
            entrant,
            season,
            public_scores(content),
            hidden_scores(hidden, team),
            gap(hidden, public),
        ),
        refusal=None,
        hidden_rmse_mm=tuple(episode.scores.rmse_mm for episode in hidden.episodes),
    )


def amount(season: Season) -> int:
    """Return how many episodes :func:`evaluate` counts, if nothing is refused."""
    size = season.suite.size
    played = 0 if shipped_references(season.suite) else len(SPECS) * size
    return 2 * (size + audited(size)) + played + size


def play_team(
    season: Season, *, executor: Executor | None = None, watch: Watch | None = None
) -> Reference:
    """Return the human-human team on a season's hidden episodes: once a season.

    Raises
    ------
    EvaluatorFault, KeyboardInterrupt
        As :func:`evaluate`.
    """
    watch = watch or Watch()
    watch.stage("human-human team")
    run = human_team_run(season.hidden, executor=executor, progress=watch.progress)
    return Reference.of(_complete(run))


def _references(season: Season, executor: Executor | None, watch: Watch) -> dict[str, Reference]:
    """Return the references on the public episodes."""
    shipped = shipped_references(season.suite)
    if shipped is not None:
        return shipped
    played = play_references(season.suite, executor=executor, progress=watch.progress)
    if len(played) < len(SPECS):
        raise KeyboardInterrupt
    return played


def _complete(run: Run) -> Run:
    if not run.complete:
        raise KeyboardInterrupt
    return run


def _verify(bundle: Path, executor: Executor | None, watch: Watch) -> None:
    """Replay the bundle. We have just written it: if that fails, it is this machine."""
    verdict = verify(bundle, executor=executor, progress=watch.progress)
    if not verdict.ok:
        told = "; ".join(map(str, verdict.findings[:3]))
        raise EvaluatorFault(f"the public run is not repeated by its replay: {told}")


def _row(
    entrant: Entrant, season: Season, public: PublicScores, hidden: HiddenScores, gap_mm: Estimate
) -> Row:
    isolation = entrant.policy.isolation
    return Row(
        season=season.name,
        commitment=season.commitment,
        suite=season.suite.name,
        suite_digest=season.suite.digest,
        name=entrant.name,
        authors=entrant.authors,
        description=entrant.description,
        link=entrant.link,
        submission=entrant.digest,
        public=public,
        hidden=hidden,
        gap_mm=gap_mm,
        isolation=isolation,
        verified=isolation in VERIFIABLE,
        scoring=SCORING,
        versions=versions(),
    )


def versions() -> dict[str, str]:
    """Return the versions of the packages that can change a number."""
    return {name: version(name) for name in LIBRARIES}
