"""Submissions to a board on the web: uploaded, and followed until they have ended."""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

from ..agents.errors import InputError
from ..agents.submissions.submission import Submission
from ..leaderboard.client import API, RemoteBoard
from ..leaderboard.pages.links import ServiceLinks
from ..leaderboard.records.row import BoardRow
from .progress import job_bar
from .tables.row import Outcome

LOOK_S = 1.0
"""How often a job is looked at [s]."""


@dataclass(frozen=True)
class There:
    """A board on the web that knows who submits."""

    board: RemoteBoard

    @classmethod
    def open(cls, url: str, token: str) -> Self:
        """Return a board that has taken the token for somebody's.

        Raises
        ------
        InputError
            If there is no token, or the board does not answer or does not know it.
        """
        if not token:
            raise InputError(
                f"board {url} needs a token: --token or COLIFT_TOKEN; who runs the board "
                "makes one by: colift token add NAME"
            )
        board = RemoteBoard(url, token)
        board.submitter()
        return cls(board)

    def submitted(self, submission: Submission) -> Outcome:
        """Return what comes of a submission.

        Raises
        ------
        InputError
            If the board does not answer or refuses.
        """
        job = self.board.submit(submission.folder)
        print(f"submitted; job {self._place(job)}", flush=True)
        try:
            return self._outcome(_ended(self.board, job))
        except KeyboardInterrupt:
            return Outcome(reason=f"the board goes on without you: {self._place(job)}")

    def _outcome(self, job: Mapping[str, Any]) -> Outcome:
        if job["state"] == "evaluator fault":
            told = f"evaluator fault, not the policy's: {job['reason']}\nSubmit again."
            return Outcome(reason=told)
        if job["state"] == "cancelled":
            return Outcome(reason=f"cancelled by {job['reason']}")
        if job["state"] == "failed":
            told = f"refused, so there is no row: {job['reason']}\nIts log: {self._place(job)}"
            return Outcome(reason=told, mend=True)
        table = self.board.standings(job["season"])
        mine = next(each for each in table if each["row"]["submission"] == job["submission"])
        same = [each for each in table if each["section"] == mine["section"]]
        bundle = f"{self._api}/entries/{job['season']}/{job['submission']}/bundle.zip"
        return Outcome(
            row=BoardRow.read(mine["row"]),
            section=mine["section"],
            ranking=tuple((each["group"], BoardRow.read(each["row"])) for each in same),
            next=f"Bundle of the public run: {bundle}\n"
            f"Its page: {self._pages.policy(job['season'], job['submission'])}",
        )

    def _place(self, job: Mapping[str, Any]) -> str:
        return f"{self._pages.root}/jobs/{job['id']}"

    @property
    def _pages(self) -> ServiceLinks:
        return ServiceLinks(self.board.url.rstrip("/"))

    @property
    def _api(self) -> str:
        return self.board.url.rstrip("/") + API


def _ended(board: RemoteBoard, job: dict[str, Any]) -> dict[str, Any]:
    """Return a job when it has ended; show until then how far it is."""
    with job_bar(job["name"], job["total"]) as bar:
        while job["ended_at"] is None:
            bar.at(job["stage"] or job["state"], job["done"], job["total"])
            time.sleep(LOOK_S)
            job = board.job(job["id"])
    return job
