"""Many upload at once: each is taken once, or told why not."""

from collections import Counter
from concurrent.futures import ThreadPoolExecutor

import pytest
from colift.leaderboard.queue import Queue, Quota
from colift.leaderboard.service.dependencies import Rates

from ... import web

UPLOADS = 200
TOKENS = 20


@pytest.fixture(scope="module")
def headers(add_token):
    """The headers of each submitter."""
    return [
        {"Authorization": f"Bearer {add_token(f'team{i}')}", "Content-Type": "application/zip"}
        for i in range(TOKENS)
    ]


@pytest.mark.slow
def test_each_of_200_uploads_is_taken_once_or_refused_with_the_reason(
    folder, serving, opening, headers, zipped
):
    """Each submitter sends ten, two of them the same; five may wait in the queue."""
    bodies = [zipped(f"p{i if i % 10 else i + 1}") for i in range(UPLOADS)]
    with serving(folder, Rates()) as url:

        def upload(number):
            # Each has a client of its own: threads of one take connections away from each other.
            return web.post(
                f"{url}/api/v1/submissions",
                headers=headers[number // 10],
                content=bodies[number],
                timeout=120,
                verify=False,
            )

        with ThreadPoolExecutor(UPLOADS) as pool:
            answers = list(pool.map(upload, range(UPLOADS)))
    codes = Counter(answer.status_code for answer in answers)
    assert set(codes) == {202, 429}
    taken = [answer.json() for answer in answers if answer.status_code == 202]
    with opening(folder) as board:
        jobs = Queue(board).jobs(limit=10 * UPLOADS)
    assert {job["id"] for job in taken} == {job.id for job in jobs}  # None lost, none more.
    assert len({job.submission for job in jobs}) == len(jobs)  # None doubled.
    waiting = Counter(job.submitter for job in jobs)
    assert waiting == {f"team{i}": Quota().open for i in range(TOKENS)}
    for answer in answers:
        if answer.status_code == 429:
            assert "submissions in the queue, at most 5 may be" in answer.json()["error"]
    assert not list((folder / "submissions").glob(".*"))
