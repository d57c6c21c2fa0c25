"""Evaluation of a submission in a season, reproducible from these two alone."""

import dataclasses
from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import TypedDict

from colift.agents.sandbox.host.levels import VERIFIABLE
from colift.agents.spec import AgentSpec
from colift.base.errors import EvaluatorFault, InputError
from colift.benchmark.bundle import results, write_bundle
from colift.benchmark.comparison.playing import play_references
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import SCORING
from colift.benchmark.execution.distributions import library_versions
from colift.benchmark.execution.runner import Run, run_suite
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.results.baselines import (
    BASELINES,
    HUMAN_HUMAN,
    human_human_run,
    play_baselines,
    shipped_baselines,
)
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import Estimate
from colift.benchmark.suites.suite import Suite
from colift.benchmark.verification import verify
from colift.benchmark.verification.audit import RULE, audit, audited
from colift.benchmark.verification.checking import (
    MACHINE,
    check_part,
    checked_with,
    presubmission_checks,
)
from colift.leaderboard.evaluation.entrant import Entrant
from colift.leaderboard.evaluation.progress import HIDDEN, Budget, Callbacks, Stage
from colift.leaderboard.evaluation.scoring import failure_lines, gap, hidden_scores, public_scores
from colift.leaderboard.records.row import BoardRow, HiddenScores, PublicScores
from colift.leaderboard.records.season import Season


@dataclass(frozen=True, kw_only=True)
class EntrantResult:
    """Result of an evaluation: a row, or the reason for its refusal."""

    row: BoardRow | None
    refusal: str | None
    hidden_rmse_mm: tuple[float, ...] = dataclasses.field(default=(), repr=False)
    """RMSE of each hidden episode that counts, for the ranks. Never published."""


def evaluate_entrant(
    entrant: Entrant,
    season: Season,
    human_human: ScoreTable,
    bundle: Path,
    *,
    executor: Executor | None = None,
    watch: Callbacks | None = None,
    budget: Budget | None = None,
) -> EntrantResult:
    """Evaluate a submission: check, public run, its audit and verification, hidden run and audit.

    It depends on its arguments alone and keeps no state: it can be repeated if interrupted.

    Parameters
    ----------
    entrant
        The submission or built-in policy.
    season
        Suite and secret.
    human_human
        The human-human baseline on the hidden episodes; see :func:`play_human_human`.
    bundle
        Folder for the bundle of the public run.
    executor
        Runs the episodes; None runs all in this process.
    watch
        Progress callbacks.
    budget
        Time budget of the policy.

    Returns
    -------
    EntrantResult
        The row; or the refusal, if the audit found that episodes cannot be repeated.

    Raises
    ------
    InputError
        If the policy fails the check or in all public lifts, or takes more time than it may.
    EvaluatorFault
        If the machine failed: the submission is not to blame, and is evaluated again.
    KeyboardInterrupt
        After Ctrl-C: there are no partial rows.
    """
    watch, budget = watch or Callbacks(), budget or Budget()
    playing: PlayingOptions = {"executor": executor, "progress": watch.progress, "keep": budget.add}
    watch.stage("check")
    _check(entrant, season.suite, playing, watch)
    watch.stage("public run")
    public = run_suite(entrant.policy, season.suite, **playing)
    baselines = _baselines(season, executor, watch)
    content = results(public, baselines)
    write_bundle(bundle, public, content.plain(), human_human=baselines[HUMAN_HUMAN])
    if all(episode.failure is not None for episode in public.episodes):
        watch.output(public.episodes[0].log)
        reasons = "; ".join(failure_lines(public.episodes)[:3])
        raise InputError(f"it fails in every public lift: {reasons}")
    watch.stage("audit")
    finding = audit(entrant.fresh, public, season.secret, **playing)
    if finding is not None:
        return EntrantResult(row=None, refusal=finding.describe(public))
    watch.stage("verification")
    _verify(bundle, executor, watch)
    watch.stage(HIDDEN)
    hidden = run_suite(entrant.policy, season.hidden, secret=season.secret, **playing)
    finding = audit(entrant.fresh, hidden, season.secret, **playing)
    if finding is not None:
        return EntrantResult(row=None, refusal=f"played again, a hidden episode differs: {RULE}")
    return EntrantResult(
        row=_row(
            entrant,
            season,
            public_scores(content),
            hidden_scores(hidden, human_human),
            gap(
                ScoreTable.of(hidden).against(human_human),
                ScoreTable.of(public).against(baselines[HUMAN_HUMAN]),
            ),
        ),
        refusal=None,
        hidden_rmse_mm=tuple(ScoreTable.of(hidden).rmse_mm),
    )


class PlayingOptions(TypedDict):
    """The player of an entrant's episodes; see :func:`.run_suite`."""

    executor: Executor | None
    progress: Callable[[int], None]
    keep: Callable[[int, Episode], None]


def _check(entrant: Entrant, suite: Suite, playing: PlayingOptions, watch: Callbacks) -> None:
    """Check a policy as ``colift check`` does, with the same code.

    Its lifts are public, so the output of one that fails may be shown.

    Raises
    ------
    InputError
        If it fails.
    """

    def play(policy: AgentSpec, suite: Suite) -> Run:
        if policy is entrant.policy:
            return run_suite(policy, suite, **playing)
        return run_suite(policy, suite, executor=playing["executor"])

    for check in presubmission_checks(entrant.policy, entrant.fresh, play, checked_with(suite)):
        if check.name == MACHINE:
            raise EvaluatorFault(check.message)
        if not check.ok:
            watch.output(check.printed)
            raise InputError(f"the check of its {check.name} failed: {check.message}")


def episode_count(season: Season) -> int:
    """Return the number of episodes that :func:`evaluate` counts, if nothing is refused."""
    played = 0 if shipped_baselines(season.suite) else len(BASELINES) * season.suite.size
    return sum(stage_episodes(season.suite).values()) + played


def stage_episodes(suite: Suite) -> dict[Stage, int]:
    """Return the number of episodes of each stage of an evaluation on a suite, in their order."""
    audit = audited(suite.size)
    return {
        "check": check_part(checked_with(suite)).size,
        "public run": suite.size,
        "audit": audit,
        "verification": suite.size,
        "hidden run": suite.size + audit,
    }


def play_human_human(
    season: Season, *, executor: Executor | None = None, watch: Callbacks | None = None
) -> ScoreTable:
    """Return the human-human baseline on a season's hidden episodes; needed once per season.

    Raises
    ------
    EvaluatorFault, KeyboardInterrupt
        As :func:`evaluate`.
    """
    watch = watch or Callbacks()
    watch.stage("two people")
    return ScoreTable.of(human_human_run(season.hidden, executor=executor, progress=watch.progress))


def play_season_references(
    season: Season,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> dict[str, ScoreTable]:
    """Return the references of a season's suite on its hidden episodes, by name.

    They stand beside the rows, on the rows' lifts. ``progress`` is called with each number of
    episodes that has been played.
    """
    known = suite_references(season.hidden)
    return play_references(known, season.hidden, executor=executor, progress=progress)


def _baselines(
    season: Season, executor: Executor | None, watch: Callbacks
) -> dict[str, ScoreTable]:
    """Return the baselines on the public episodes."""
    shipped = shipped_baselines(season.suite)
    if shipped is not None:
        return shipped
    return play_baselines(season.suite, executor=executor, progress=watch.progress)


def _verify(bundle: Path, executor: Executor | None, watch: Callbacks) -> None:
    """Verify the bundle. It was just written, so a failure is a fault of this machine."""
    verdict = verify(bundle, executor=executor, progress=watch.progress)
    if not verdict.ok:
        message = "; ".join(map(str, verdict.findings[:3]))
        raise EvaluatorFault(f"verification of the public run failed: {message}")


def _row(
    entrant: Entrant, season: Season, public: PublicScores, hidden: HiddenScores, gap: Estimate
) -> BoardRow:
    about, isolation = entrant.manifest, entrant.policy.isolation
    return BoardRow(
        season=season.name,
        commitment=season.commitment,
        suite=season.suite.name,
        suite_digest=season.suite.digest,
        name=about.name,
        authors=about.authors,
        description=about.description,
        link=about.link,
        licence=about.licence,
        trained_on=about.trained_on,
        submission=entrant.digest,
        public=public,
        hidden=hidden,
        gap=gap,
        isolation=isolation,
        verified=isolation in VERIFIABLE,
        scoring=SCORING,
        versions=versions(),
    )


def versions() -> dict[str, str]:
    """Return the versions of the packages that can change a number."""
    return {"colift": version("colift"), **library_versions()}
