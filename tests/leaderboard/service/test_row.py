"""From an upload to a verified row, by a real worker; and all that is published of it."""

import io
import json
import subprocess
import sys
import zipfile

import pytest
import schemathesis
from colift.benchmark.verification import verify
from colift.leaderboard.core.decisions import Decisions

pytestmark = pytest.mark.slow

SUBMIT = "/api/v1/submissions"


@pytest.fixture(scope="module")
def news(client, folder, ada, zipped):
    """The events of a job from its upload to its end; meanwhile a worker makes the row."""
    authors = ('authors = ["Your Name"]', 'authors = ["=1+1", "<script>alert(1)</script>"]')
    job = client.post(SUBMIT, headers=ada, content=zipped("mine", manifest=authors)).json()
    command = [sys.executable, "-m", "colift.cli", "worker", "--board", str(folder), "--once"]
    worker = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    with client.stream("GET", f"/api/v1/jobs/{job['id']}/events", timeout=200) as answer:
        assert answer.headers["Content-Type"].startswith("text/event-stream")
        lines = [line for line in answer.iter_lines() if line]
    assert worker.wait(60) == 0
    assert set(lines[::2]) == {"event: job"}
    return [json.loads(line.removeprefix("data: ")) for line in lines[1::2]]


@pytest.fixture(scope="module")
def done(news):
    return news[-1]


@pytest.fixture(scope="module")
def place(done):
    return f"/api/v1/entries/{done['season']}/{done['submission']}"


def test_the_progress_is_told_to_the_end(client, news):
    assert news[0]["state"] == "queued"
    assert {"running", "verifying"} & {each["state"] for each in news}
    assert news[-1]["state"] == "done"
    assert news[-1]["ended_at"] is not None
    assert news[-1]["done"] == news[-1]["total"] > 0
    counted = [each["done"] for each in news]
    assert counted == sorted(counted)
    assert client.get(f"/api/v1/jobs/{news[0]['id']}").json() == news[-1]


def test_who_listens_after_the_end_hears_it_once(client, done):
    with client.stream("GET", f"/api/v1/jobs/{done['id']}/events") as answer:
        text = "".join(answer.iter_text())
    assert text == f"event: job\ndata: {text[17:].strip()}\n\n"
    assert json.loads(text[17:]) == done


def test_the_row_is_verified_and_says_what_was_submitted(client, done, place):
    entry = client.get(place).json()
    assert entry["submission"] == done["submission"]
    assert entry["submitter"] == "ada"
    assert entry["refusal"] is None
    assert entry["row"]["verified"] is True
    assert entry["row"]["name"] == "mine"
    assert entry["row"]["authors"] == ["=1+1", "<script>alert(1)</script>"]
    assert (entry["row"]["licence"], entry["row"]["trained_on"]) == ("MIT", "nothing")
    assert 0 < entry["row"]["hidden"]["rmse_mm"]["mean"] < 250
    (standing,) = client.get("/api/v1/standings").json()
    assert standing["row"] == entry["row"]
    assert standing["rank"] == 1
    assert standing["strata"] is None


def test_what_is_answered_is_what_the_document_describes(client, url, done, place):
    schema = schemathesis.openapi.from_url(f"{url}/api/v1/openapi.json")
    for path, template in {
        "/api/v1/seasons": "/api/v1/seasons",
        "/api/v1/standings": "/api/v1/standings",
        "/api/v1/standings?behaviour=pause": "/api/v1/standings",
        place: "/api/v1/entries/{season}/{digest}",
        f"/api/v1/jobs/{done['id']}": "/api/v1/jobs/{job}",
    }.items():
        answer = client.get(path)
        assert answer.status_code == 200
        schema[template]["GET"].validate_response(answer)


def test_the_lifts_of_a_behaviour_or_subject_are_told(client, done):
    def strata(**asked):
        (standing,) = client.get("/api/v1/standings", params=asked).json()
        return [(stratum["behaviour"], stratum["subject"]) for stratum in standing["strata"]]

    subject = strata(behaviour="pause")[0][1]
    assert {behaviour for behaviour, _ in strata(behaviour="pause")} == {"pause"}
    assert {who for _, who in strata(subject=subject)} == {subject}
    assert strata(behaviour="pause", subject=subject) == [("pause", subject)]
    answer = client.get("/api/v1/standings", params={"behaviour": "dance"})
    assert answer.status_code == 422
    assert "behaviour dance is not in this season, which has " in answer.json()["error"]
    assert "pause" in answer.json()["error"]


def test_the_bundle_can_be_taken_home_and_verified(client, place, tmp_path):
    answer = client.get(client.get(place).json()["bundle"])
    assert answer.headers["Content-Type"] == "application/zip"
    with zipfile.ZipFile(io.BytesIO(answer.content)) as archive:
        archive.extractall(tmp_path)
    assert verify(tmp_path).ok


def test_the_table_can_be_read_by_pandas_and_starts_no_formula(client, done):
    import pandas as pd  # 60 MB, which every process of the tests would have.

    frame = pd.read_csv(io.StringIO(client.get("/api/v1/standings.csv").text))
    assert frame["submission"].tolist() == [done["submission"]]
    assert frame["authors"].tolist() == ["'=1+1, <script>alert(1)</script>"]
    assert (frame["licence"].tolist(), frame["trained_on"].tolist()) == (["MIT"], ["nothing"])
    assert frame["rmse_mm"].between(0, 250).all()


def test_a_withdrawn_row_stays_to_be_seen(client, folder, opening, done, place):
    with opening(folder) as board:
        Decisions(board).withdraw(done["season"], done["submission"], "ada", "a mistake")
    try:
        (standing,) = client.get("/api/v1/standings").json()
        assert standing["rank"] == 0
        (event,) = standing["events"]
        assert (event["kind"], event["who"], event["why"]) == ("withdrawal", "ada", "a mistake")
        assert client.get(place).json()["events"] == [event]
    finally:
        with opening(folder) as board:
            Decisions(board).reinstate(done["season"], done["submission"], "ada", "none after all")
    assert client.get("/api/v1/standings").json()[0]["rank"] == 1


def test_the_same_content_submitted_again_is_the_same_row(client, ada, zipped, done):
    authors = ('authors = ["Your Name"]', 'authors = ["=1+1", "<script>alert(1)</script>"]')
    again = client.post(SUBMIT, headers=ada, content=zipped("mine", manifest=authors))
    assert again.status_code == 202
    assert again.json() == done
