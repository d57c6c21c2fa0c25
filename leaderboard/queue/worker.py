"""Worker of a queue: evaluation of submissions into rows."""

import contextlib
import logging
import time
import traceback
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from pathlib import Path
from textwrap import indent
from typing import Final

import sqlalchemy as sa
from colift.agents.spec import AUTO
from colift.base.errors import EvaluatorFault, InputError, error_text
from colift.benchmark.bundle import read_bundle
from colift.benchmark.execution.runner import placed
from colift.leaderboard.core.board import BUILTIN, LOCAL, Board
from colift.leaderboard.core.decisions import Decisions
from colift.leaderboard.evaluation.entrant import (
    Entrant,
    NoSandboxError,
    board_level,
    builtin_entrant,
)
from colift.leaderboard.evaluation.evaluate import (
    EntrantResult,
    episode_count,
    evaluate_entrant,
    play_human_human,
)
from colift.leaderboard.evaluation.progress import (
    HIDDEN,
    BudgetError,
    Callbacks,
    HiddenRunTimer,
    Stage,
)
from colift.leaderboard.evaluation.scoring import failure_lines
from colift.leaderboard.queue import LostError, Queue, WorkerQueue
from colift.leaderboard.queue.heartbeat import Heartbeat
from colift.leaderboard.queue.jobs import this_worker
from colift.leaderboard.records.job import Job
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.records.season import BoardEntry
from colift.leaderboard.records.times import utc_second
from colift.leaderboard.replays.chosen import replays_of

log: Final = logging.getLogger("colift.worker")

IDLE_S: Final = 1.0
"""Time between two queries of an empty queue [s]."""

DETAILS: Final = "the details are for the maintainer of the board"
"""Published reason of a fault after the policy has met hidden lifts."""


@dataclass(frozen=True)
class Worker:
    """A worker of a board's queue."""

    work: WorkerQueue
    executor: Executor | None = None
    """Runs the episodes; None runs all in this process."""
    name: str = field(default_factory=this_worker)
    isolation: str = AUTO
    """Isolation level of policies; see :func:`.board_level`."""

    def run(
        self,
        stop: Callable[[], bool] = lambda: False,
        ended: Callable[[Job], None] = lambda j: None,
    ) -> None:
        """Work until ``stop`` returns True.

        Parameters
        ----------
        stop
            Called before each job.
        ended
            Called with every job that was worked on.
        """
        with self.attending():
            while not stop():
                try:
                    job = self.once()
                except sa.exc.OperationalError:
                    job = None  # The database is away, or its disk is full; that may end.
                if job is None:
                    time.sleep(IDLE_S)
                else:
                    ended(job)

    @contextlib.contextmanager
    def attending(self) -> Iterator[None]:
        """Say at the end of the body that this worker takes no more jobs."""
        try:
            yield
        finally:
            with contextlib.suppress(sa.exc.DBAPIError):  # Without it, its signature gets old.
                self.work.leave(self.name)

    def once(self, job: str | None = None, watch: Callbacks | None = None) -> Job | None:
        """Work on the next job and return it; None if none waits.

        Parameters
        ----------
        job
            Id of a job; None is the next one.
        watch
            Progress callbacks.

        Raises
        ------
        KeyboardInterrupt
            After Ctrl-C; the job is queued again.
        """
        claimed = self.work.claim(self.name, job)
        if claimed is None:
            return None
        try:
            self._work(claimed, watch or Callbacks())
        except LostError as lost:
            self._log(claimed, str(lost))
        now = Queue(self._board).job(claimed.id)
        if now is not None and now.state == "done":  # Before a reader looks.
            self._board.standings(now.season)
            self._make_replays(now)
        return now

    def rescore(
        self, season: str, digest: str, who: str, why: str, watch: Callbacks | None = None
    ) -> BoardRow:
        """Evaluate a row's submission again, replace its bundle and return the new row.

        The entry stays as it was; the row of the last rescore is the valid one.

        Parameters
        ----------
        season, digest
            The row.
        who, why
            The actor and the reason; both are public.
        watch
            Progress callbacks.

        Raises
        ------
        InputError
            If there is no such row, or the policy now fails or is refused: the row stays.
        EvaluatorFault
            If this machine failed.
        """
        entry = self._board.entry(season, digest)
        if entry is None or entry.row is None:
            raise InputError(f"season {season} has no row of submission {digest}")
        with self._board.store.workspace(f"rescore-{digest[:16]}", 1) as files:
            made = files / "bundle"
            _, result = self._evaluate(entry, made, watch or Callbacks())
            if result.row is None:
                raise InputError(
                    f"{entry.name} keeps its row, but would be refused now: {result.refusal}"
                )
            Decisions(self._board).rescore(season, result.row, result.hidden_rmse_mm, who, why)
            self._board.store.place_bundle(season, digest, made)
        return result.row

    def _make_replays(self, job: Job) -> None:
        bundle = self._board.bundle(job.season, job.submission)
        if bundle is not None:
            with contextlib.suppress(InputError):
                replays_of(bundle, job.name)

    def _work(self, job: Job, watch: Callbacks) -> None:
        """Evaluate a job and record its outcome."""
        self._log(job, f"attempt {job.attempt}")
        heartbeat = Heartbeat(self.work, job, self._logged(job, watch))
        try:
            with self._board.store.workspace(job.id, job.attempt) as files:
                with heartbeat:
                    entry, evaluation = self._evaluate(job, files / "bundle", heartbeat.watch())
                self._log(job, *_failures(files / "bundle"))
                self.work.finish(job, entry, evaluation.hidden_rmse_mm, files / "bundle")
            self._log(job, "done" if entry.refusal is None else f"refused: {entry.refusal}")
        except LostError:
            raise
        except KeyboardInterrupt:
            self._log(job, "interrupted; queued again")
            with contextlib.suppress(sa.exc.DBAPIError):  # Without it, its lease ends.
                self.work.release(job)
            raise
        except NoSandboxError as error:
            self._log(job, f"evaluator fault, not the policy's: {error}")
            self.work.postpone(job, str(error))
        except InputError as error:
            self._failed(job, heartbeat.stage, error)
        except Exception as error:
            self._faulty(job, heartbeat.stage, error)

    def _evaluate(
        self, job: Job | BoardEntry, bundle: Path, watch: Callbacks
    ) -> tuple[BoardEntry, EntrantResult]:
        level = board_level(self.isolation).level
        try:
            entrant = self._entrant(job, level)
            policy, fresh = (placed(p, self.executor) for p in (entrant.policy, entrant.fresh))
            entrant = replace(entrant, policy=policy, fresh=fresh)
            season = self._board.season_of(job.season)
        except InputError as error:
            raise EvaluatorFault(str(error)) from error  # It was good when it was submitted.
        secrets = self._board.store.secrets(job.season)
        watch.total(
            episode_count(season) + (0 if secrets.known_human_human() else season.suite.size)
        )
        human_human = secrets.human_human(
            lambda: play_human_human(season, executor=self.executor, watch=watch)
        )
        # Whoever writes to the folder can read the secret: no need to hide the duration from them.
        hold = HiddenRunTimer(0 if job.submitter in (LOCAL, BUILTIN) else season.hidden.size)
        watch = replace(watch, stage=_both(hold.stage, watch.stage))
        try:
            evaluation = evaluate_entrant(
                entrant, season, human_human, bundle, executor=self.executor, watch=watch
            )
        except LostError:
            raise
        except Exception:
            hold.wait()
            raise
        hold.wait()
        entry = BoardEntry(
            season=job.season,
            submission=job.submission,
            name=job.name,
            submitter=job.submitter,
            at=self._board.clock(),  # Until it is published, see WorkerQueue.finish.
            row=evaluation.row,
            refusal=evaluation.refusal,
        )
        return entry, evaluation

    def _entrant(self, job: Job | BoardEntry, level: str) -> Entrant:
        """Return the submission, or the built-in policy."""
        if job.submitter != BUILTIN:
            return Entrant.of(self._board.store.submission(job.submission), level)
        builtin = builtin_entrant(job.name, level)
        if builtin.digest != job.submission:
            raise InputError(f"the built-in {job.name} differs from the one that was queued")
        return builtin

    def _failed(self, job: Job, stage: Stage | None, error: InputError) -> None:
        """End a job by a failure of its policy."""
        shown = stage != HIDDEN or isinstance(error, BudgetError)
        reason = str(error) if shown else "it cannot be loaded for the hidden lifts"
        self._log(job, f"failed: {reason}")
        self.work.fail(job, reason)

    def _faulty(self, job: Job, stage: Stage | None, error: Exception) -> None:
        """Queue a job again after a fault of this machine."""
        trace = "".join(traceback.format_exception(error))
        try:
            self._board.store.add_to_private_log(job.season, job.id, trace)
        except OSError as refused:
            log.error(
                "job %s: %s; its log cannot be written: %s", job.id, error_text(error), refused
            )
        reason = DETAILS if stage == HIDDEN else error_text(error)
        reason = f"in {stage or 'the beginning'}: {reason}"
        self._log(job, f"evaluator fault, not the policy's, {reason}")
        self.work.fault(job, reason)

    def _logged(self, job: Job, watch: Callbacks) -> Callbacks:
        """Return callbacks that also log the stages, and the output of a policy that fails."""

        def stage(name: Stage) -> None:
            self._log(job, name)
            watch.stage(name)

        def output(text: str) -> None:
            if text.strip():  # Indented, so that no line of it is taken for one of the log.
                self._log(job, "it printed:\n" + indent(text.strip("\n"), "    "))
            watch.output(text)

        return replace(watch, stage=stage, output=output)

    def _log(self, job: Job, *lines: str) -> None:
        now = utc_second(self._board.clock())
        for line in lines:
            try:
                self._board.store.add_to_log(job.id, f"{now} {line}")
            except OSError as refused:  # Most likely a full disk, which does not stop the work.
                log.error("job %s: %s; its log cannot be written: %s", job.id, line, refused)

    @property
    def _board(self) -> Board:
        return self.work.board


def _failures(bundle: Path) -> list[str]:
    """Return the log lines on failed public episodes."""
    episodes = read_bundle(bundle).run().episodes
    failed = sum(episode.failure is not None for episode in episodes)
    return [f"{failed} of {len(episodes)} public lifts failed", *failure_lines(episodes)]


def _both(*listeners: Callable[[Stage], None]) -> Callable[[Stage], None]:
    """Return a callback that calls several in their order."""

    def each(stage: Stage) -> None:
        for one in listeners:
            one(stage)

    return each
