"""Takes submissions out of the queue and makes rows of them."""

import time
import traceback
from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final

import sqlalchemy as sa

from ..agents.errors import EvaluatorFault, InputError, told
from ..benchmark.bundle import read_bundle
from ..benchmark.cluster import Cluster
from ..benchmark.shipping import shipped
from .board import OWN, Board
from .entry import Entry
from .evaluation import Entrant, Evaluation, Stage, Watch, amount, evaluate, play_team
from .job import Job
from .own import own_entrant
from .pulse import Pulse
from .queue import LostError, Queue, Work
from .worker_name import this_worker

IDLE_S: Final = 1.0
"""Time between two looks into an empty queue [s]."""

FAILURES: Final = 20
"""So many failed public episodes are told in a log."""

OPEN: Final[tuple[Stage | None, ...]] = (None, "human-human team", "public run")
"""Stages before the policy has met a hidden episode: what goes wrong in them may be told."""


@dataclass(frozen=True)
class Worker:
    """A worker of a board's queue."""

    work: Work
    executor: Executor | None = None
    """Runs the episodes; None runs all in this process."""
    name: str = field(default_factory=this_worker)

    def run(
        self,
        stop: Callable[[], bool] = lambda: False,
        ended: Callable[[Job], None] = lambda j: None,
    ) -> None:
        """Work until it is told to stop.

        Parameters
        ----------
        stop
            Asked before each job.
        ended
            Called with every job that was worked on.
        """
        while not stop():
            try:
                job = self.once()
            except sa.exc.OperationalError:
                job = None  # The database is away; it may come back.
            if job is None:
                time.sleep(IDLE_S)
            else:
                ended(job)

    def once(self, job: str | None = None, watch: Watch | None = None) -> Job | None:
        """Return the job that was worked on, as it is now; None if nothing waits.

        Parameters
        ----------
        job
            Id of the only one that is wanted.
        watch
            Whom else to tell how far it is.

        Raises
        ------
        KeyboardInterrupt
            After Ctrl-C; the job is queued again.
        """
        claimed = self.work.claim(self.name, job)
        if claimed is None:
            return None
        try:
            self._work(claimed, watch or Watch())
        except LostError as lost:
            self._log(claimed, str(lost))
        now = Queue(self._board).job(claimed.id)
        if now is not None and now.state == "done":
            self._board.standings(now.season)  # So that no reader waits for the ranks.
        return now

    def _work(self, job: Job, watch: Watch) -> None:
        """Take a job to its end, whatever that is."""
        self._log(job, f"attempt {job.attempt}")
        pulse = Pulse(self.work, job, self._logged(job, watch))
        try:
            with self._board.store.workspace(job.id, job.attempt) as files:
                with pulse:
                    entry, evaluation = self._evaluate(job, files / "bundle", pulse.watch())
                self._log(job, *_failures(files / "bundle"))
                self.work.finish(job, entry, evaluation.hidden_rmse_mm, files / "bundle")
            self._log(job, "done" if entry.refusal is None else f"refused: {entry.refusal}")
        except LostError:
            raise
        except KeyboardInterrupt:
            self._log(job, "interrupted; queued again")
            self.work.release(job)
            raise
        except InputError as error:
            self._failed(job, pulse.stage, error)
        except Exception as error:
            self._faulty(job, pulse.stage, error)

    def _evaluate(self, job: Job, bundle: Path, watch: Watch) -> tuple[Entry, Evaluation]:
        try:
            entrant = self._placed(self._entrant(job))
            season = self._board.season_of(job.season)
        except InputError as error:
            raise EvaluatorFault(str(error)) from error  # It was good when it was submitted.
        vault = self._board.store.vault(job.season)
        watch.total(amount(season) + (0 if vault.known_team() else season.suite.size))
        team = vault.team(lambda: play_team(season, executor=self.executor, watch=watch))
        evaluation = evaluate(entrant, season, team, bundle, executor=self.executor, watch=watch)
        entry = Entry(
            season=job.season,
            submission=job.submission,
            name=job.name,
            submitter=job.submitter,
            at=self._board.clock(),
            row=evaluation.row,
            refusal=evaluation.refusal,
        )
        return entry, evaluation

    def _entrant(self, job: Job) -> Entrant:
        """Return who is evaluated: what was submitted, or a policy of the project's own."""
        if job.submitter != OWN:
            return Entrant.of(self._board.store.submission(job.submission))
        own = own_entrant(job.name)
        if own.digest != job.submission:
            raise InputError(f"colift's own {job.name} is not the one that was queued")
        return own

    def _placed(self, entrant: Entrant) -> Entrant:
        """Return the entrant as the executor's machines can run it."""
        if not isinstance(self.executor, Cluster):
            return entrant
        return replace(entrant, policy=shipped(entrant.policy), fresh=shipped(entrant.fresh))

    def _failed(self, job: Job, stage: Stage | None, error: InputError) -> None:
        """End a job whose policy cannot be loaded."""
        reason = str(error) if stage in OPEN else "it cannot be loaded for the hidden episodes"
        self._log(job, f"failed: {reason}")
        self.work.fail(job, reason)

    def _faulty(self, job: Job, stage: Stage | None, error: Exception) -> None:
        """Queue a job again that this machine has failed."""
        trace = "".join(traceback.format_exception(error))
        self._board.store.add_to_private_log(job.season, job.id, trace)
        reason = told(error) if stage in OPEN else "the details are for who keeps the board"
        reason = f"in {stage or 'the beginning'}: {reason}"
        self._log(job, f"evaluator fault, not the policy's, {reason}")
        self.work.fault(job, reason)

    def _logged(self, job: Job, watch: Watch) -> Watch:
        """Return who is told of the stages, and writes them down."""

        def stage(name: Stage) -> None:
            self._log(job, name)
            watch.stage(name)

        return replace(watch, stage=stage)

    def _log(self, job: Job, *lines: str) -> None:
        now = f"{self._board.clock():%Y-%m-%d %H:%M:%S}"
        for line in lines:
            self._board.store.add_to_log(job.id, f"{now} {line}")

    @property
    def _board(self) -> Board:
        return self.work.board


def _failures(bundle: Path) -> list[str]:
    """Return what a log says of the public episodes that failed."""
    episodes = read_bundle(bundle).run().episodes
    failed = [episode for episode in episodes if episode.failure is not None]
    lines = [f"{len(failed)} of {len(episodes)} public episodes failed"]
    for each in failed[:FAILURES]:
        lines.append(f"{each.behaviour}/{each.subject} seed {each.seed}: {each.failure}")
    return lines
