"""The JSON interface of an empty board: shapes, and answers to who asks for nonsense."""

import errno
import logging
import re

import pytest
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.service import published

from ... import web

DIGEST = "0" * 64
JOB = "0" * 32


def test_the_season_is_published_and_its_secret_is_not(client, folder):
    (season,) = client.get("/api/v1/seasons").json()
    assert season["name"] == "1"
    assert season["suite"] == "quick-v1"
    assert season["suite_digest"] == make_suite("quick-v1").digest
    assert season["current"] is True
    assert season["revealed"] is None
    secret = (folder / "private/1/secret").read_text().strip()
    assert len(secret) == 64
    assert secret not in client.get("/api/v1/seasons").text


def test_an_empty_board_has_no_rows(client):
    assert client.get("/api/v1/standings").json() == []
    assert client.get("/api/v1/standings", params={"behaviour": "pause"}).json() == []
    lines = client.get("/api/v1/standings.csv").text.splitlines()
    assert len(lines) == 1
    assert lines[0].startswith("section,rank,name,")


def test_the_service_says_that_it_is_well(client):
    assert client.get("/healthz").json() == {"status": "ok", "season": "1"}


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("/nothing", "there is no '/nothing' here"),
        ("/api/v1/standings?season=7", "there is no season 7; the seasons are 1"),
        ("/api/v1/standings.csv?season=7", "there is no season 7; the seasons are 1"),
        (f"/api/v1/entries/1/{DIGEST}", f"season 1 has no entry {DIGEST}"),
        (f"/api/v1/entries/1/{DIGEST}/bundle.zip", f"season 1 has no bundle of {DIGEST}"),
        (f"/api/v1/jobs/{JOB}", f"there is no job {JOB}"),
        (f"/api/v1/jobs/{JOB}/events", f"there is no job {JOB}"),
        ("/static/../../private/1/secret", "there is no"),
        ("/static/%2e%2e/%2e%2e/private/1/secret", "there is no"),
    ],
)
def test_what_is_not_there_is_said_so(client, path, message):
    answer = client.get(path)
    assert answer.status_code == 404
    assert message in answer.json()["error"]


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("/api/v1/standings?season=' OR 1=1 --", 'query season: .*pattern.*got "\' OR 1=1 --"'),
        ("/api/v1/standings?season=%00", r"query season: .*got '\\x00'"),
        ("/api/v1/standings?behaviour=<script>", "query behaviour: .*got '<script>'"),
        ("/api/v1/standings?subject=" + "x" * 500, r"query subject: .*got 'x{60}\.\.\.'$"),
        ("/api/v1/jobs/1", "path job: .*got '1'"),
        ("/api/v1/jobs/%F0%28%8C%28", "path job: "),
        ("/api/v1/entries/1/..%2f..%2fsecret", "path digest|there is no"),
        ("/api/v1/entries/1;DROP TABLE entries/" + DIGEST, "path season: "),
    ],
)
def test_a_value_that_cannot_be_is_named(client, path, message):
    answer = client.get(path)
    assert answer.status_code in (404, 422)
    assert list(answer.json()) == ["error"]
    assert re.search(message, answer.json()["error"])


BROWSER = {"Accept": "text/html,application/xhtml+xml,*/*;q=0.8"}


@pytest.mark.parametrize("path", ["/nopage", "/jobs/1", "/seasons/%00", "/no/<b>page</b>"])
def test_a_wrong_address_is_a_page_for_browsers_and_json_for_programs(client, path):
    page = client.get(path, headers=BROWSER)
    assert page.status_code == 404
    assert page.headers["Content-Type"].startswith("text/html")
    assert "This board has no page at this address." in page.text
    assert 'href="/"' in page.text
    assert list(client.get(path).json()) == ["error"]


@pytest.mark.parametrize("path", ["/api/v1/nothing", "/api/v1/jobs/1", "/static/nothing.js"])
def test_a_wrong_address_of_the_interface_is_json_for_browsers_too(client, path):
    assert list(client.get(path, headers=BROWSER).json()) == ["error"]


def test_a_wrong_address_below_a_proxys_path_is_answered_in_the_same_way(folder, serving):
    with serving(folder, root="/board") as url:
        page = web.get(f"{url}/nopage", headers=BROWSER)
        assert 'href="/board/"' in page.text
        assert list(web.get(f"{url}/api/v1/nothing", headers=BROWSER).json()) == ["error"]


@pytest.mark.parametrize("method", ["PUT", "DELETE", "PATCH", "TRACE"])
def test_nothing_can_be_changed(client, method):
    answer = client.request(method, "/api/v1/standings")
    assert answer.status_code == 405
    assert answer.json() == {"error": f"{method} is not possible here; GET is"}


def test_a_fault_of_ours_is_logged_and_told_without_its_inside(client, monkeypatch, caplog):
    def fail(service, season):
        raise RuntimeError(f"{service.board.folder} is broken")

    monkeypatch.setattr(published, "_standings", fail)
    with caplog.at_level(logging.ERROR, "colift.service"):
        answer = client.get("/api/v1/standings")
    request = answer.headers["X-Request-ID"]
    assert answer.status_code == 500
    assert answer.json() == {
        "error": f"the board has failed; please inform the maintainer that request {request} failed"
    }
    assert f"request {request}: GET '/api/v1/standings' failed" in caplog.text
    assert "is broken" in caplog.text
    assert "Content-Security-Policy" in answer.headers


def test_a_full_disk_is_told(client, monkeypatch):
    def fail(service, season):
        raise OSError(errno.ENOSPC, "No space left on device", "/board/x")

    monkeypatch.setattr(published, "_standings", fail)
    answer = client.get("/api/v1/standings")
    assert answer.status_code == 507
    assert answer.json() == {"error": "the board has no room left; please inform its maintainer"}


def test_the_api_is_described_without_anything_from_elsewhere(client):
    document = client.get("/api/v1/openapi.json").json()
    page = client.get("/api").text
    for path, methods in document["paths"].items():
        for method in methods:
            anchor = re.sub(r"[{}]", "", f"{method}{path}".replace("/", "-"))
            assert f'<a href="#{anchor}">' in page
            assert f'<h2 id="{anchor}">' in page
    for name in document["components"]["schemas"]:
        assert f'id="{name}"' in page
        assert f'href="#{name}"' in page
    assert "HTTPValidationError" not in page
    assert not re.search(r'(src|href)="(https?:)?//', page)
    assert "<script" not in page
    assert "style=" not in page


def test_behind_a_proxy_all_addresses_have_its_path(folder, serving, ada, zipped):
    """A proxy shows us below /lab, which it takes away before it asks us."""
    with serving(folder, root="/lab") as url:
        page = web.get(f"{url}/").text
        api = web.get(f"{url}/api").text
        answer = web.post(f"{url}/api/v1/submissions", headers=ada, content=zipped("lab"))
        assert web.get(url + answer.headers["Location"].removeprefix("/lab")).status_code == 200
    assert answer.headers["Location"] == f"/lab/api/v1/jobs/{answer.json()['id']}"
    for text in (page, api):
        found = re.findall(r'(?:src|href)="([^"]*)"', text)
        assert found
        assert all(each.startswith(("/lab/", "#")) for each in found)
