"""Uploads by strangers: who may, what is refused, and that nothing of it is left."""

import io
import stat
import zipfile

import httpx
import pytest
import sqlalchemy as sa
from colift.base.errors import InputError
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.database.schema import jobs
from colift.leaderboard.queue import Queue, WorkerQueue
from colift.leaderboard.storage.staging import PREFIX

from .uploaded import SUBMIT, packed

pytestmark = pytest.mark.usefixtures("nothing_is_left")


def test_a_submission_is_taken_and_its_job_can_be_asked_for(client, ada, zipped):
    answer = client.post(SUBMIT, headers=ada, content=zipped("first"))
    assert answer.status_code == 202
    job = answer.json()
    assert (job["name"], job["submitter"], job["state"]) == ("first", "ada", "queued")
    assert answer.headers["Location"] == f"/api/v1/jobs/{job['id']}"
    assert client.get(answer.headers["Location"]).json() == job
    assert "worker" not in job
    again = client.post(SUBMIT, headers=ada, content=zipped("first"))
    assert again.json()["id"] == job["id"]


def test_a_board_without_a_worker_says_so_with_the_answer_to_the_upload(client, ada, zipped):
    job = client.post(SUBMIT, headers=ada, content=zipped("unattended")).json()
    said = "Nobody evaluates at present: no worker of this board has been seen"
    assert job["unattended"].startswith(said)
    path = f"/api/v1/jobs/{job['id']}"
    assert client.get(path).json()["unattended"] == job["unattended"]
    assert said in client.get(f"/jobs/{job['id']}").text
    ended = client.delete(path, headers=ada).json()
    assert (ended["state"], ended["unattended"]) == ("cancelled", None)
    assert "colift queue" not in client.get(f"/jobs/{job['id']}").text, "that is for the maintainer"


def test_one_policy_is_one_job_whatever_system_packed_it(client, ada, zipped):
    """Its digest is that of the files with the line ends of Unix, without what systems add."""
    with zipfile.ZipFile(io.BytesIO(zipped("anywhere"))) as archive:
        files = [(name, archive.read(name)) for name in archive.namelist()]
    windows = [(name, data.replace(b"\n", b"\r\n")) for name, data in files]
    junk = [("Thumbs.db", "x"), ("desktop.ini", "x")]
    finder = [(f"mine/{name}", data) for name, data in files] + [("__MACOSX/mine/._policy.py", "x")]
    jobs = [
        client.post(SUBMIT, headers=ada, content=packed(*entries)).json()
        for entries in (files, files + junk, windows, windows + junk, finder)
    ]
    assert len({(job["id"], job["submission"]) for job in jobs}) == 1


@pytest.mark.parametrize("authors", ['["Your Name"]', '["Ada", "your name"]'])
def test_the_author_of_the_template_is_refused(client, ada, zipped, authors, folder):
    signed = ('authors = ["Your Name"]', f"authors = {authors.replace('Your', 'YOUR')}")
    answer = client.post(SUBMIT, headers=ada, content=zipped("unsigned", manifest=signed))
    assert answer.status_code == 422
    assert "policy.toml: authors still has " in answer.json()["error"]
    assert "put your own name there" in answer.json()["error"]


@pytest.mark.parametrize(
    "authorization",
    [
        None,
        "",
        "Bearer",
        "Bearer wrong",
        "Bearer ' OR 1=1 --",
        "Basic YTpi",
        "Bearer \xff",
    ],
)
def test_without_a_token_that_counts_nothing_is_taken(client, folder, zipped, authorization):
    headers = {"Content-Type": "application/zip"}
    if authorization is not None:
        headers["Authorization"] = authorization.encode("latin-1")
    answer = client.post(SUBMIT, headers=headers, content=zipped("nobody"))
    assert answer.status_code == 401
    assert answer.headers["WWW-Authenticate"] == "Bearer"
    assert answer.json()["error"].endswith("; ask the maintainer of the board for a token")
    assert "colift token" not in answer.text, "that is for the maintainer"


def test_who_asks_whose_a_token_is_gets_told(client, ada):
    assert client.get("/api/v1/me", headers=ada).json() == {"submitter": "ada"}
    answer = client.get("/api/v1/me", headers={"Authorization": "Bearer wrong"})
    assert answer.status_code == 401
    assert "this token is not valid" in answer.json()["error"]


def test_a_revoked_token_does_not_count_any_more(client, folder, opening, add_token, zipped):
    headers = {"Authorization": f"Bearer {add_token('eve')}", "Content-Type": "application/zip"}
    assert client.post(SUBMIT, headers=headers, content=b"no zip").status_code == 422
    with opening(folder) as board:
        Tokens(board).revoke("eve")
    answer = client.post(SUBMIT, headers=headers, content=zipped("eves"))
    assert answer.status_code == 401
    assert "revoked" in answer.json()["error"]


@pytest.mark.parametrize("kind", ["text/html", "multipart/form-data; boundary=x", "", "a" * 500])
def test_another_kind_of_body_is_refused(client, ada, zipped, kind):
    answer = client.post(SUBMIT, headers={**ada, "Content-Type": kind}, content=zipped())
    assert answer.status_code == 415
    assert "application/zip" in answer.json()["error"]


def symlink(name, target):
    entry = zipfile.ZipInfo(name)
    entry.create_system, entry.external_attr = 3, (stat.S_IFLNK | 0o777) << 16
    return entry, target


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ([("../policy.py", "x")], "zip entry ../policy.py: "),
        ([("policy.py", "x"), ("../../../../tmp/x", "x")], "zip entry ../../../../tmp/x: "),
        ([("/etc/cron.d/x", "x")], "zip entry /etc/cron.d/x: "),
        ([symlink("policy.py", "/etc/passwd")], "zip entry policy.py: a symbolic link"),
        ([("a", bytes(30 * 2**20))], "would become 30 MiB, more than 200 times larger"),
        ([(f"f{i}", "x") for i in range(501)], "holds more than 500 files and folders"),
        ([("policy.py", "x")], "the zip archive has no policy.toml"),
        ([], "the zip archive is empty: it holds no file of a submission"),
        ([("mine/", "")], "the zip archive is empty: it holds no file of a submission"),
        ([("a/b/policy.toml", "")], "found a/b/policy.toml: pack the folder that contains it, a/b"),
        ([("policy.toml.txt", "")], "found policy.toml.txt: rename it to policy.toml"),
        ([("a/POLICY.TOML", "")], "found a/POLICY.TOML: rename it to policy.toml, in small"),
        ([("policy.toml", "name = 1"), ("policy.py", "")], "policy.toml: "),
        ([("policy.toml", "\xff\x00".encode("latin-1")), ("policy.py", "")], "policy.toml: "),
        ([("policy.toml", "a = " + "[" * 5000), ("policy.py", "")], "policy.toml: "),
    ],
)
def test_a_bad_archive_is_refused_with_the_reason(client, folder, ada, entries, message):
    answer = client.post(SUBMIT, headers=ada, content=packed(*entries))
    assert answer.status_code == 422
    assert message in answer.json()["error"]
    assert str(folder) not in answer.text
    assert PREFIX not in answer.text


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ('authors = ["Your Name"]', """authors = ["'); DROP TABLE jobs; --"]"""),
        ('authors = ["Your Name"]', 'authors = ["<script>alert(1)</script>", "=1+1"]'),
        ('trained_on = "nothing"', 'trained_on = "<img src=x onerror=alert(1)>"'),
        ('licence = "MIT"', """licence = "' OR '1'='1" """),
        ('link = ""', 'link = "https://example.org/?q=\'><script>"'),
    ],
)
def test_texts_that_mean_something_elsewhere_are_texts_here(client, add_token, zipped, key, value):
    name = f"t{abs(hash((key, value)))}"
    headers = {"Authorization": f"Bearer {add_token(name)}", "Content-Type": "application/zip"}
    answer = client.post(SUBMIT, headers=headers, content=zipped(name, manifest=(key, value)))
    assert answer.status_code == 202
    assert client.get(answer.headers["Location"]).json()["state"] == "queued"


@pytest.mark.parametrize("name", ["<b>x</b>", "x'; DROP TABLE jobs", "../x", "x\\u0000", "blend"])
def test_a_name_that_means_something_elsewhere_is_refused(client, ada, zipped, name):
    answer = client.post(SUBMIT, headers=ada, content=zipped(name))
    assert answer.status_code == 422
    assert "policy.toml: name must" in answer.json()["error"]


@pytest.mark.slow
def test_much_that_is_packed_well_in_many_files_is_refused(client, folder, ada):
    before = sorted(folder.rglob("*"))
    many = packed(*((f"f{i}", bytes(16 * 2**20)) for i in range(15)))
    assert len(many) < 2**18
    answer = client.post(SUBMIT, headers=ada, content=many)
    assert answer.status_code == 422
    assert "would become 240 MiB, more than 200 times larger" in answer.json()["error"]
    assert sorted(folder.rglob("*")) == before


def test_a_file_that_was_cut_short_is_repaired_by_the_same_upload(
    client, folder, opening, ada, zipped
):
    """As a power failure leaves it; meanwhile the job has ended by a fault of the evaluator."""
    body = zipped("cut")
    job = client.post(SUBMIT, headers=ada, content=body).json()
    policy = folder / "submissions" / job["submission"] / "policy.py"
    whole = policy.read_bytes()
    policy.write_bytes(whole[:100])
    with opening(folder) as board:
        work = WorkerQueue(board)
        with pytest.raises(InputError, match="not as it was submitted"):
            board.store.submission(job["submission"])
        with board.database.writing() as connection:
            connection.execute(
                sa.update(jobs)
                .where(jobs.c.id == job["id"])
                .values(state="evaluator fault", ended_at=board.clock())
            )
        again = client.post(SUBMIT, headers=ada, content=body).json()
        assert (again["id"], again["state"], again["ended_at"]) == (job["id"], "queued", None)
        assert policy.read_bytes() == whole
        board.store.submission(job["submission"])
        assert work.claim("one", job["id"]) is not None


def test_who_has_too_much_in_the_queue_is_told_so(client, folder, opening, add_token, zipped):
    headers = {"Authorization": f"Bearer {add_token('max')}", "Content-Type": "application/zip"}
    answers = [client.post(SUBMIT, headers=headers, content=zipped(f"max{i}")) for i in range(6)]
    assert [answer.status_code for answer in answers] == [202] * 5 + [429]
    assert "max has 5 submissions in the queue" in answers[-1].json()["error"]
    with opening(folder) as board:
        assert sum(job.submitter == "max" for job in Queue(board).jobs(limit=1000)) == 5


def test_every_answer_to_an_upload_is_json(client, ada):
    for content in (b"", b"\0" * 100, b"PK\x05\x06" + bytes(18)):
        answer = client.post(SUBMIT, headers=ada, content=content)
        assert answer.status_code == 422
        assert list(answer.json()) == ["error"]
    assert isinstance(answer, httpx.Response)
