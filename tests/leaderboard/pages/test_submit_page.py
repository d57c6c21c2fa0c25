"""From a zip file in a browser to a verified row, or to the reason why not."""

import re
import threading
from pathlib import Path

import pytest
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.queue import Queue, WorkerQueue
from colift.leaderboard.queue.worker import Worker
from colift.leaderboard.storage.archive import pack_archive
from playwright.sync_api import expect

from ..signed import write_signed
from .conftest import running

pytestmark = pytest.mark.slow

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
def page(own_page):
    """A page of its own: it keeps a token."""
    return own_page


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
        write_signed(folder)
        manifest = folder / "policy.toml"
        manifest.write_text(manifest.read_text().replace('"my-policy"', f'"{name}"'))
        if code:
            (folder / "policy.py").write_text(code)
        with path.open("w+b") as file:
            pack_archive(folder, file)
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
    page.goto("about:blank")  # The page of a job loads itself anew when it ends.
    Worker(WorkerQueue(queue.board)).once()
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
    expect(page.locator("#status")).to_have_text("Waiting.")
    expect(page.locator("#unattended")).to_contain_text("Nobody evaluates at present: no worker")
    # Told, not asked for: the page is loaded anew when the job ends.
    seen: list[str] = []
    page.expose_function("tell", lambda told: seen.append(told))
    page.evaluate("""() => {
        const read = (id) => document.getElementById(id).textContent;
        const look = () => window.tell(`${read("state")}, ${read("status")}`);
        new MutationObserver(look).observe(document.getElementById("status"), {childList: true});
    }""")
    working = threading.Thread(target=Worker(WorkerQueue(queue.board)).once)
    working.start()
    while working.is_alive():
        page.wait_for_timeout(100)
    working.join()
    expect(page.get_by_text("Done: it is on the board")).to_be_visible()
    assert any(re.match(r"(running|verifying), .* \d+ of \d+ lifts", told) for told in seen)
    page.get_by_role("link", name="See the board").click()
    # In the ranking, or apart from it where this machine was too busy for a step in time.
    expect(
        page.get_by_role("main").get_by_role("link", name="template", exact=True)
    ).to_be_visible()
    expect(page.get_by_role("main")).not_to_contain_text("not verified")


def test_a_failure_is_told_with_its_reason_and_the_log(page, url, queue, token, zipped):
    job = evaluated(page, url, queue, zipped("moody", MOODY), token)
    assert job.state == "failed"
    expect(page.locator(".notice.bad")).to_have_text(f"The submission failed: {job.reason}")
    assert page.locator("pre").text_content().strip() == job.log.strip()
    # It failed the check, before anything was entered: there is no page of it.
    expect(page.get_by_role("link", name="See its page")).to_have_count(0)


def test_why_lifts_failed_is_told_in_the_policys_own_words(page, url, queue, token, zipped):
    job = evaluated(page, url, queue, zipped("faulty", FAULTY), token)
    assert job.state == "failed"
    assert "no <b>idea</b>" in job.reason + job.log
    expect(page.locator("main")).to_contain_text("no <b>idea</b>")
    expect(page.locator("section[aria-labelledby=log] pre")).to_contain_text("<i>about</i> to fail")
    page.goto(url)
    expect(page.get_by_role("link", name="faulty")).to_have_count(0)


def test_what_is_not_accepted_is_told_why_and_nothing_is_queued(page, url, queue, token, zipped):
    before = len(queue.jobs())
    upload(page, url, zipped("other"), "wrong-token")
    expect(page.get_by_role("alert")).to_contain_text("this token is not valid")
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


def test_a_cancelled_submission_is_no_fault_of_the_machine(page, url, queue, token, zipped):
    upload(page, url, zipped("unwanted"), token)
    page.wait_for_url("**/jobs/*")
    queue.cancel(page.url.rpartition("/")[2], "Grace", "too long")
    notice = page.locator(".notice.bad")
    expect(notice).to_contain_text("Cancelled by Grace: too long.")
    expect(notice).not_to_contain_text("machine")


def test_my_submissions_are_shown_to_who_has_the_token_and_the_token_stays_in_the_tab(
    page, url, queue, token, zipped
):
    upload(page, url, zipped("mine"), token)
    page.wait_for_url("**/jobs/*")
    page.goto(f"{url}/submit")
    expect(page.get_by_label("Your token")).to_have_value(token)
    page.get_by_role("button", name="Show my submissions").click()
    mine = page.get_by_role("region", name="My submissions").last
    expect(mine.locator("tbody tr")).to_have_count(1)
    expect(mine).to_contain_text("queued")
    mine.get_by_role("link", name="mine").click()
    expect(page.get_by_role("heading", level=1)).to_have_text("mine")
    elsewhere = page.context.new_page()
    elsewhere.goto(f"{url}/submit")
    expect(elsewhere.get_by_label("Your token")).to_have_value("")
    elsewhere.get_by_role("button", name="Show my submissions").click()
    expect(elsewhere.locator("#whose")).to_contain_text("Authorization")


def test_the_rules_stand_beside_the_button(page, url):
    page.goto(f"{url}/submit")
    rules = page.get_by_role("region", name="The rules")
    for told in (
        "64 MiB",
        "filterpy, numpy, scikit-learn, scipy",
        "5 submissions",
        "licence",
        "10 in 24 hours",
    ):
        expect(rules).to_contain_text(told)
    button = page.get_by_role("button", name="Submit").bounding_box()
    box = rules.bounding_box()
    assert box["y"] < button["y"] < box["y"] + box["height"]
    expect(page.get_by_role("link", name="the template as a zip file")).to_be_visible()
