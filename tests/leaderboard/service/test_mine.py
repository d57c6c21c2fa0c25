"""What a submitter is told of what is theirs, and the rules for all."""

import pytest
from colift.leaderboard.queue import NO_QUOTA, Queue, Quota, QuotaError, WorkerQueue

from ... import web
from ..rows import make_entry

MINE = "/api/v1/me/submissions"


def test_one_sees_all_of_ones_own_submissions_and_no_others(
    client, folder, opening, add_token, zipped
):
    bob, eve = (
        {"Authorization": f"Bearer {add_token(name)}", "Content-Type": "application/zip"}
        for name in ("bob", "eve")
    )
    jobs = [
        client.post("/api/v1/submissions", headers=who, content=zipped(name)).json()
        for who, name in ((bob, "bob1"), (eve, "eve1"), (bob, "bob2"))
    ]
    with opening(folder) as board:
        work = WorkerQueue(board)
        job = work.claim("one", jobs[0]["id"])
        made = make_entry(board, "bob1")
        work.finish(job, type(made)(**{**vars(made), "submission": job.submission}))
        work.fail(work.claim("one", jobs[2]["id"]), "it raises")
    told = client.get(MINE, headers=bob).json()
    assert [(each["name"], each["state"], each["reason"]) for each in told] == [
        ("bob2", "failed", "it raises"),
        ("bob1", "done", None),
    ]
    assert told[0]["entry"] is None
    assert client.get(told[1]["entry"]).json()["row"]["name"] == "bob1"
    assert client.get(told[1]["job"]).json()["id"] == told[1]["id"] == jobs[0]["id"]
    assert [each["name"] for each in client.get(MINE, headers=eve).json()] == ["eve1"]


def test_a_fault_does_not_tell_the_folders_of_the_server(client, folder, opening, ada, zipped):
    job = client.post("/api/v1/submissions", headers=ada, content=zipped("lost")).json()
    path = folder / "submissions" / job["submission"]
    with opening(folder) as board:
        work = WorkerQueue(board)
        work.fault(work.claim("one", job["id"]), f"No space left: '{path}/x.txt', /opt/colift/a.py")
        board.store.add_to_log(job["id"], f"cannot read {path}/policy.py")
    told = client.get(f"/api/v1/jobs/{job['id']}").json()
    assert told["reason"] == "No space left: 'x.txt', a.py"
    assert told["log"] == "cannot read policy.py\n"
    assert str(folder) not in client.get(f"/jobs/{job['id']}").text


def test_one_cancels_ones_own_and_nobody_elses(client, folder, opening, add_token, zipped):
    joe, kay = (
        {"Authorization": f"Bearer {add_token(name)}", "Content-Type": "application/zip"}
        for name in ("joe", "kay")
    )
    job = client.post("/api/v1/submissions", headers=joe, content=zipped("joe")).json()
    place = f"/api/v1/jobs/{job['id']}"
    assert client.delete(place).status_code == 401
    assert client.delete(place, headers=kay).status_code == 403
    assert client.get(place).json()["state"] == "queued"
    ended = client.delete(place, headers=joe)
    assert (ended.status_code, ended.json()["state"]) == (200, "cancelled")
    assert client.get(place).json() == ended.json()
    assert client.get(MINE, headers=joe).json()[0]["state"] == "cancelled"
    assert client.delete(place, headers=joe).status_code == 409
    assert client.delete(f"/api/v1/jobs/{'0' * 32}", headers=joe).status_code == 404
    with opening(folder) as board:
        assert WorkerQueue(board).claim("one", job["id"]) is None


def test_without_a_token_nothing_is_ones_own(client):
    assert client.get(MINE).status_code == 401
    assert client.get(MINE, headers={"Authorization": "Bearer x"}).status_code == 401


def test_the_rules_are_those_that_hold(folder, serving):

    with serving(folder, contact="board@lab.example") as url:
        told = web.get(f"{url}/api/v1/rules").json()
    assert (told["season"], told["suite"]) == ("1", "quick-v1")
    assert (told["open_jobs"], told["kept_bytes"]) == (Quota().open, Quota().size)
    assert told["packages"] == ["filterpy", "numpy", "scikit-learn", "scipy"]
    assert told["contact"] == "board@lab.example"


def test_what_is_kept_of_a_submitter_is_bounded(open_board, write_submission):
    board = open_board(suite="quick-v1")
    first, second = (
        board.keep(write_submission(f"class Policy: ...  # {name}", name=name)) for name in "ab"
    )
    size = first.contents.size
    queue = Queue(board, Quota(size=size + second.contents.size - 1))
    queue.enqueue(first, "ada")
    with pytest.raises(QuotaError, match="may be kept in all: ask the maintainer"):
        queue.enqueue(second, "ada")
    assert queue.enqueue(first, "ada").submitter == "ada"  # It takes nothing more.
    queue.enqueue(second, "grace")
    assert len(Queue(board, NO_QUOTA).jobs()) == 2
