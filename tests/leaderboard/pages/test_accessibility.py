"""Every page: with axe-core, in light and dark, on a telephone, and without inline code."""

import re

import pytest
from colift.leaderboard.core.board import Board
from colift.leaderboard.queue import Queue, WorkerQueue

from ... import web
from ...browser import violations
from ..signed import write_signed
from .boards import digest

pytestmark = pytest.mark.slow

PAGES = (
    "/",
    "/seasons/2025",
    "/seasons/1",
    f"/seasons/2026/policies/{digest('copy')}",
    f"/seasons/2026/policies/{digest('<b>sly</b>')}",
    f"/seasons/2026/compare?p={digest('copy')}&p={digest('blend')}",
    "/seasons/2026/compare",
    "/seasons/2026/behaviours",
    "/seasons/2026/behaviours/changing_goal",
    "/method",
    "/open",
    "/submit",
    "/job",
    f"/seasons/2026/policies/{digest('copy')}/replays",
    "/seasons/9",
)


@pytest.fixture(scope="module")
def job(folder, tmp_path_factory):
    """The page of a job that has failed, with a log."""
    place = tmp_path_factory.mktemp("job") / "mine"
    write_signed(place)
    board = Board.open(folder)
    queue = Queue(board)
    queued = queue.enqueue(board.keep(place), "ada")
    work = WorkerQueue(board)
    work.fail(work.claim("here"), "it did not start", "line\n" * 100)
    board.close()
    return f"/jobs/{queued.id}"


@pytest.fixture(params=PAGES)
def path(request, job):
    return job if request.param == "/job" else request.param


def test_everybody_can_read_a_page(page, url, path):
    """Nothing for axe-core, in light and dark; and a telephone is wide enough."""
    page.emulate_media(color_scheme="light", reduced_motion="reduce")
    page.goto(url + path)
    assert violations(page) == []
    page.emulate_media(color_scheme="dark", reduced_motion="reduce")
    assert violations(page, {"runOnly": ["color-contrast"]}) == []
    page.set_viewport_size({"width": 390, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


def test_a_filtered_board_can_be_read_too(page, url):
    page.goto(f"{url}/#behaviour=jerky&sort=-rmse")
    assert violations(page) == []


def test_nothing_in_a_page_is_inline(url, path):
    """The service's content security policy would leave it out."""
    text = web.get(url + path, follow_redirects=True).text
    assert "</html>" in text
    assert "<style" not in text
    assert not re.search(r"<[^>]*\s(style|on\w+)=", text)
    for attributes, _ in re.findall(r"<script([^>]*)>(.*?)</script>", text, re.DOTALL):
        assert "src=" in attributes or 'type="application/json"' in attributes
