"""A metric of the test's own: an entry in the table and a value are all that it needs."""

import csv
import io
import json

import httpx
import numpy as np
import pytest
from colift.benchmark.bundle import read_bundle
from colift.benchmark.episode.metric import Metric
from colift.benchmark.results import baselines
from colift.benchmark.tasks.level.table import LEVEL_METRICS
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.verification import verify
from colift.leaderboard.core.board import Board
from colift.leaderboard.pages.site import write_site

from ...cli.conftest import colift
from .boards import digest, practice
from .conftest import running

__all__ = ["colift"]

ADDED = Metric(
    name="peak_mm",
    symbol="peak",
    label="Peak",
    unit="mm",
    digits=1,
    shown="board",
    meaning="largest height of the robot's end",
)


@pytest.fixture(autouse=True)
def added():
    """Add the metric as somebody would who works on ``level``."""
    score = Level.score

    def with_peak(self, lift, trace, *, failed):
        peak = 1000 * float(trace.robot_end.max(initial=0.0))
        return {**score(self, lift, trace, failed=failed), ADDED.name: peak}

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(Level, "score", with_peak)
        patched.setitem(LEVEL_METRICS, ADDED.name, ADDED)
        # Baselines of before, whose digests such a change leaves behind.
        patched.setattr(baselines, "shipped_content", dict)
        patched.setattr(baselines, "_played", {})
        yield


@pytest.fixture
def folder(added, tmp_path):
    """A board with one row."""
    board = Board.open(tmp_path / "board", "quick-v1")
    board.import_season(practice(tmp_path, "2026", ("copy",)))
    write_site(board, tmp_path / "site")
    board.close()
    return tmp_path / "board"


@pytest.mark.slow
def test_it_is_in_every_file_answer_and_page(folder, colift):
    board = Board.look(folder)
    bundle = board.bundle("2026", digest("copy"))
    board.close()
    assert bundle is not None
    content = read_bundle(bundle)
    mean = np.mean([episode.scores[ADDED.name] for episode in content.episodes])
    assert 100 < mean < 300
    summary = json.loads((bundle / "results.json").read_text())["summary"]
    assert summary[ADDED.name] == {"mean": pytest.approx(mean), "missing": 0}
    assert verify(bundle).ok
    with running(folder) as url, httpx.Client(base_url=url, timeout=60) as client:
        front = client.get("/").text
        page = client.get(f"/seasons/2026/policies/{digest('copy')}").text
        table = csv.DictReader(io.StringIO(client.get("/api/v1/standings.csv").text))
        standings = client.get("/api/v1/standings", params={"behaviour": "pause"}).json()
    lines = {line["name"]: line for line in table}
    assert float(lines["copy"][ADDED.name]) == pytest.approx(mean)
    first = next(each for each in standings if each["row"]["name"] == "copy")
    assert first["row"]["public"]["metrics"][ADDED.name]["mean"] == pytest.approx(mean)
    assert first["strata"][0]["metrics"][ADDED.name]["missing"] == 0
    assert f'class="num metric {ADDED.name}"' in front
    assert f"{mean:.1f}" in front
    assert ADDED.label in page
    for columns in ("board", "compare"):
        names = (
            ("--board", str(folder)) if columns == "board" else ("copy", "hold", "--seeds", "0:1")
        )
        done = colift(columns, *names, COLUMNS="160")
        assert done.returncode == 0, done.stderr
        assert ADDED.symbol in done.stdout
