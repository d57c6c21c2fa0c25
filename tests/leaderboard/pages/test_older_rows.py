"""A board whose rows are older than a metric of its suite, over HTTP and in the terminal."""

import csv
import dataclasses
import io
import json

import httpx
import pytest
from colift.benchmark.bundle.files import RESULTS
from colift.leaderboard.core.board import Board
from colift.leaderboard.pages.site import write_site

from ...cli.conftest import colift
from .boards import digest
from .conftest import running

NEWER = ("sparc", "human_force_n")
"""What the rows lack: all metrics of the board but the one that ranks."""

__all__ = ["colift"]


def older(content, name):
    """Remove a metric from a part of results.json, or of a row."""
    return {key: value for key, value in content.items() if key != name}


@pytest.fixture(params=[NEWER[:1], NEWER[1:], NEWER], ids="+".join)
def newer(request):
    """The metrics that the rows are older than."""
    return request.param


@pytest.fixture
def folder(played, newer, tmp_path):
    """A board that was made without some metrics: rows, public runs, human-human baseline."""
    entries = []
    for each in played.entries:
        content = json.loads(each.files[RESULTS])
        metrics, groups = each.entry.row.public.metrics, content["groups"]
        for name in newer:
            metrics = older(metrics, name)
            groups = [older(group, name) for group in groups]
        files = {**each.files, RESULTS: json.dumps({**content, "groups": groups}).encode()}
        public = dataclasses.replace(each.entry.row.public, metrics=metrics)
        row = dataclasses.replace(each.entry.row, public=public)
        entry = dataclasses.replace(each.entry, row=row)
        entries.append(dataclasses.replace(each, entry=entry, files=files))
    means = {k: v for k, v in played.human_human.means.items() if k not in newer}
    human_human = dataclasses.replace(played.human_human, means=means)
    board = Board.open(tmp_path / "board", "quick-v1")
    board.import_season(dataclasses.replace(played, entries=entries, human_human=human_human))
    write_site(board, tmp_path / "site")
    board.close()
    return tmp_path / "board"


@pytest.mark.slow
def test_every_page_and_file_shows_the_row_without_the_newer_metric(folder, newer):
    copy, blend = digest("copy"), digest("blend")
    with running(folder) as url, httpx.Client(base_url=url, timeout=60) as client:
        for page in (
            f"/seasons/2026/policies/{copy}",
            f"/seasons/2026/compare?p={copy}&p={blend}",
            "/seasons/2026/behaviours",
            "/seasons/2026/behaviours/pause",
            "/seasons/2026/feed.atom",
            "/method",
        ):
            assert client.get(page).status_code == 200, page
        front = client.get("/").text
        table = csv.DictReader(io.StringIO(client.get("/api/v1/standings.csv").text))
        lines = {line["name"]: line for line in table}
        standings = client.get("/api/v1/standings", params={"behaviour": "pause"}).json()
    first = next(each for each in standings if each["row"]["name"] == "copy")
    strata = first["strata"]
    assert len(strata) == 3
    for name in newer:
        assert f'class="num metric {name}" data-value="" ' in front
        assert lines["copy"][name] == ""
        assert first["row"]["public"]["metrics"][name] == {"mean": None, "missing": 12}
        assert all(each["metrics"][name] == {"mean": None, "missing": 1} for each in strata)
    for name in set(NEWER) - set(newer):
        assert float(lines["copy"][name])


def test_the_terminal_shows_it_too(folder, newer, colift):
    done = colift("board", "--board", str(folder), COLUMNS="120")
    assert (done.returncode, done.stderr) == (0, "")
    line = next(line.split() for line in done.stdout.splitlines() if " copy " in line)
    assert line.count("none") == len(newer)
    people = next(line.split() for line in done.stdout.splitlines() if " two people " in line)
    assert people.count("none") == len(newer)
    told = json.loads(colift("board", "--board", str(folder), "--json").stdout)
    assert all(told["human_human"][name] is None for name in newer)
