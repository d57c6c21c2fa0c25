"""From a zip file in a browser to a verified row, or to the reason why not."""

import re
import threading
from pathlib import Path

import pytest
from colift.agents.submissions.new import write_template
from colift.leaderboard.archive import pack
from colift.leaderboard.board import Board
from colift.leaderboard.queue import Queue, Work
from colift.leaderboard.tokens import Tokens
from colift.leaderboard.worker import Worker
from playwright.sync_api import expect

from .conftest import running

FAULTY = """
class Policy:
    def reset(self, seed):
        print("<i>about</i> to fail")

    def act(self, observation):
        raise RuntimeError("no <b>idea</b>")
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory, tiny_suite):
    """A board of a suite of two lifts, so that an evaluation takes seconds."""
    place = tmp_path_factory.mktemp("submit") / "board"
    Board.open(place, "tiny").close()
    return place


@pytest.fixture(scope="module")
def url(folder):
    with running(folder) as address:
        yield address


@pytest.fixture
def queue(folder):
    board = Board.open(folder)
    yield Queue(board)
    board.close()


@pytest.fixture
def token(queue, request):
    return Tokens(queue.board).add(request.node.name[:30])


@pytest.fixture
def zipped(tmp_path):
    """Return what packs a submission, the template if no other code is given."""

    def make(name: str, code: str = "") -> Path:
        folder, path = tmp_path / name, tmp_path / f"{name}.zip"
        write_template(folder)
        manifest = folder / "policy.toml"
        manifest.write_text(manifest.read_text().replace('"my-policy"', f'"{name}"'))
        if code:
            (folder / "policy.py").write_text(code)
        with path.open("w+b") as file:
            pack(folder, file)
        return path

    return make


MOODY = """
import os

class Policy:
    def reset(self, seed):
        pass

    def act(self, observation):
        return [os.urandom(1)[0] / 1e4]
"""
"""Its lifts cannot be repeated."""


def evaluated(page, url, queue, path, token):
    """Upload a submission, have it evaluated, look at its page, and return the job."""
    upload(page, url, path, token)
    page.wait_for_url("**/jobs/*")
    address = page.url
    Worker(Work(queue.board)).once()
    page.goto(address)
    return queue.job(address.rpartition("/")[2])


def upload(page, url, path, token):
    page.goto(f"{url}/submit")
    page.get_by_label("Folder as a zip file").set_input_files(path)
    page.get_by_label("Your token").fill(token)
    page.get_by_role("button", name="Submit").click()


def test_an_uploaded_template_becomes_a_verified_row_before_ones_eyes(
    page, url, queue, token, zipped
):
    upload(page, url, zipped("template"), token)
    page.wait_for_url("**/jobs/*")
    expect(page.locator("#told")).to_have_text("Waiting.")
    page.evaluate("""() => {
        window.seen = [];
        const read = (id) => document.getElementById(id).textContent;
        const look = () => window.seen.push(`${read("state")}, ${read("told")}`);
        new MutationObserver(look).observe(document.getElementById("told"), {childList: true});
    }""")
    seen: list[str] = []
    working = threading.Thread(target=Worker(Work(queue.board)).once)
    working.start()
    while working.is_alive():
        page.wait_for_timeout(100)
        if page.locator("#told").count():
            seen += page.evaluate("window.seen || []")
    working.join()
    expect(page.get_by_text("Done: it is on the board")).to_be_visible()
    assert any(re.match(r"(running|verifying), .* \d+ of \d+ lifts", told) for told in seen)
    page.get_by_role("link", name="See the board").click()
    row = page.locator("table.board tbody tr")
    expect(row).to_have_count(1)
    expect(row).to_contain_text("template")
    expect(row.locator(".badge.ok")).to_contain_text("verified")


def test_a_failure_is_told_with_its_reason_and_the_log(page, url, queue, token, zipped):
    job = evaluated(page, url, queue, zipped("moody", MOODY), token)
    assert job.state == "failed"
    expect(page.locator(".notice.bad")).to_have_text(f"The submission failed: {job.reason}")
    assert page.locator("pre").text_content().strip() == job.log.strip()
    page.get_by_role("link", name="What is known of it").click()
    expect(page.get_by_text("This submission has no row")).to_be_visible()


def test_why_lifts_failed_is_told_in_the_policys_own_words(page, url, queue, token, zipped):
    job = evaluated(page, url, queue, zipped("faulty", FAULTY), token)
    assert job.state == "done"
    assert page.locator("pre").text_content().strip() == job.log.strip()
    assert "no <b>idea</b>" in job.log
    page.get_by_role("link", name="See its page").click()
    failures = page.get_by_role("region", name="Failures").first
    expect(failures).to_contain_text("2 of 2 public lifts failed")
    expect(failures).to_contain_text("no <b>idea</b>")


def test_what_is_not_accepted_is_told_why_and_nothing_is_queued(page, url, queue, token, zipped):
    before = len(queue.jobs())
    upload(page, url, zipped("other"), "wrong-token")
    expect(page.get_by_role("alert")).to_contain_text("this token does not count")
    page.get_by_label("Your token").fill(token)
    bad = zipped("bad").with_name("bad.txt.zip")
    bad.write_bytes(b"no zip")
    page.get_by_label("Folder as a zip file").set_input_files(bad)
    page.get_by_role("button", name="Submit").click()
    expect(page.get_by_role("alert")).to_contain_text("zip")
    assert page.url.endswith("/submit")
    assert len(queue.jobs()) == before


def test_the_queue_is_shown_without_the_way_to_others_jobs(page, url, queue, token, zipped):
    upload(page, url, zipped("waiting"), token)
    page.wait_for_url("**/jobs/*")
    job = page.url.rpartition("/")[2]
    page.goto(f"{url}/submit")
    waiting = page.get_by_role("region", name="Queue")
    expect(waiting).to_contain_text("waiting")
    expect(waiting).to_contain_text("queued")
    assert job not in page.content()


def test_there_is_no_page_of_an_unknown_job(page, url):
    answer = page.request.get(f"{url}/jobs/{'0' * 32}")
    assert answer.status == 404
    assert "There is no such job" in answer.text()
