"""The page of submissions: the form, the rules, the queue, and the template of a submission."""

import functools
import io
import tempfile
from pathlib import Path
from typing import Final

from colift.agents.submissions.new import PLACEHOLDER, write_template
from colift.leaderboard.client import API
from colift.leaderboard.queue import Queue
from colift.leaderboard.records.job import Job
from colift.leaderboard.storage.archive import pack_archive
from colift.leaderboard.views.method import public_episodes
from colift.leaderboard.views.page import Content, Page, Visit, find_season

WAITING: Final = 100
"""Maximum number of jobs in the queue's list."""


def open_jobs(queue: Queue) -> tuple[Job, ...]:
    """Return the present queue, oldest submission first."""
    jobs = [job for job in queue.jobs(limit=WAITING) if not job.ended]
    return tuple(sorted(jobs, key=lambda job: job.submitted_at))


@functools.cache
def template_archive() -> bytes:
    """Return the files that ``colift new`` writes, as a zip archive."""
    buffer = io.BytesIO()
    with tempfile.TemporaryDirectory(prefix="colift-") as temporary:
        folder = Path(temporary, PLACEHOLDER)
        write_template(folder)
        pack_archive(folder, buffer)
    return buffer.getvalue()


def _submit(visit: Visit) -> Content:
    season = find_season(visit.board)
    content = {"season": season, "lifts": public_episodes(visit.board, season)}
    if visit.queue is None:
        return content
    jobs = open_jobs(visit.queue)
    return {**content, "jobs": jobs, "rules": visit.rules(), "address": visit.address}


PAGES: Final = (
    Page(
        name="submit",
        url="/submit",
        file="submit.html",
        view=_submit,
        template="submit.html",
        meaning="The form for submissions, the rules and the queue.",
        menu="Submit",
        place=50,
    ),
    Page(
        name="template",
        url="/template.zip",
        file="data/template.zip",
        view=lambda visit: template_archive(),
        media="application/zip",
        headers={"Content-Disposition": f'attachment; filename="{PLACEHOLDER}.zip"'},
        meaning="The template of a submission.",
    ),
    Page(name="api_submissions", url=f"{API}/submissions"),
    Page(name="api_mine", url=f"{API}/me/submissions"),
)
