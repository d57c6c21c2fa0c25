"""A database that goes away while the service runs, and comes back."""

import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import httpx
import pytest
import sqlalchemy as sa
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.database.connection import Database

from ..postgresql import SETTINGS, as_its_user, binaries, server


@pytest.mark.slow
@pytest.mark.usefixtures("postgresql")  # To be skipped where there is none.
def test_a_server_that_stops_is_told_as_503_and_comes_back_without_a_restart(
    tmp_path, serving, zipped, monkeypatch
):
    with server() as url:
        monkeypatch.setenv("COLIFT_DATABASE_URL", url)
        place = Path(parse_qs(urlsplit(url).query)["host"][0])

        def control(*arguments):
            command = [binaries() / "pg_ctl", "-D", place / "data", *arguments]
            subprocess.run(command, check=True, **as_its_user(place))

        board = Board.open(tmp_path / "board", "quick-v1")
        token = Tokens(board).add("ada")
        board.close()
        headers = {"Authorization": f"Bearer {token}", "Content-Type": "application/zip"}
        with (
            serving(tmp_path / "board") as service,
            httpx.Client(base_url=service, timeout=60) as client,
        ):
            post = {"url": "/api/v1/submissions", "headers": headers, "content": zipped("one")}
            assert client.get("/api/v1/standings").status_code == 200
            control("stop", "-m", "fast")
            for answer in (
                client.get("/api/v1/standings"),
                client.get("/healthz"),
                client.get("/"),
                client.post(**post),
            ):
                assert answer.status_code == 503
                assert int(answer.headers["Retry-After"]) > 0
                assert "the board's database does not answer" in answer.text
                assert str(place) not in answer.text
            assert client.get("/").headers["Content-Type"].startswith("text/html")
            control("start", "-w", "-l", place / "log.txt", "-o", f"{SETTINGS} -k {place}")
            assert client.get("/api/v1/standings").status_code == 200
            assert client.get("/").status_code == 200
            assert client.post(**post).status_code == 202


def test_who_listens_to_a_job_hears_on_when_the_database_is_back(
    client, folder, ada, zipped, opening, monkeypatch
):
    job = client.post("/api/v1/submissions", headers=ada, content=zipped("heard")).json()
    reading = Database.reading
    with client.stream("GET", f"/api/v1/jobs/{job['id']}/events") as answer:
        lines = answer.iter_lines()
        assert next(lines) == "event: job"

        asked = []

        def away(database):
            asked.append(database)
            raise sa.exc.OperationalError("SELECT", {}, Exception("it is away"))

        with monkeypatch.context() as patched:
            patched.setattr(Database, "reading", away)
            while len(asked) < 2:
                time.sleep(0.05)
        monkeypatch.setattr(Database, "reading", reading)
        with opening(folder) as board, board.database.writing() as connection:
            connection.exec_driver_sql("UPDATE jobs SET stage = 'audit' WHERE name = 'heard'")
        assert any('"stage":"audit"' in line for line in lines)


def test_no_more_listen_from_an_address_than_there_are_places_for_it(client, url, ada, zipped):
    job = client.post("/api/v1/submissions", headers=ada, content=zipped("many")).json()
    path = f"{url}/api/v1/jobs/{job['id']}/events"
    limits = httpx.Limits(max_connections=None)
    with httpx.Client(timeout=60, limits=limits) as one:
        requests = [one.build_request("GET", path) for _ in range(40)]
        with ThreadPoolExecutor(40) as pool:
            answers = list(pool.map(lambda each: one.send(each, stream=True), requests))
        codes = [answer.status_code for answer in answers]
        for answer in answers:
            answer.close()
    assert (codes.count(200), codes.count(429)) == (20, 20)
