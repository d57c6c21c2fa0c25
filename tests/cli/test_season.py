"""``colift season``: a sealed season beside those that were."""

import contextlib
import hashlib

import pytest
from colift.benchmark.references.best_known import best_known_run
from colift.benchmark.results.scores import ScoreTable
from colift.cli.program import app
from colift.leaderboard.core.board import Board
from typer.testing import CliRunner


def colift(*arguments):
    return CliRunner().invoke(app, arguments)


def test_a_season_begins_with_a_secret_that_can_be_revealed_when_it_is_over(tmp_path):
    board = str(tmp_path / "board")
    begun = colift("season", "begin", "2027", "--board", board, "--suite", "quick-v1", "--no-own")
    assert begun.exit_code == 0, begun.output
    commitment = begun.output.split("commitment to its secret: ")[1].split()[0]
    early = colift("season", "reveal", "2027", "--board", board)
    assert "still takes submissions" in str(early.exception)
    next_one = colift("season", "begin", "2028", "--board", board)
    assert "policies of the project are queued" in next_one.output
    assert "on quick-v1" in next_one.output
    secret = colift("season", "reveal", "2027", "--board", board).output.split(": ")[1].strip()
    assert hashlib.sha256(bytes.fromhex(secret)).hexdigest() == commitment


@pytest.mark.slow
def test_references_are_played_on_the_hidden_lifts_of_a_season(tmp_path):
    board = str(tmp_path / "board")
    colift("season", "begin", "2027", "--board", board, "--suite", "quick-v1", "--no-own")
    told = colift("season", "references", "2027", "--board", board, "--jobs", "1").output
    with contextlib.closing(Board.open(tmp_path / "board")) as opened:
        known = opened.references("2027")
        played = best_known_run(opened.season_of("2027").hidden)
    assert known["best_known"].rmse_mm.mean == round(ScoreTable.of(played).mean, 2)
    assert f"best known (trained): {known['best_known'].rmse_mm.mean} mm on the hidden" in told


def test_a_season_has_one_life(tmp_path):
    board = str(tmp_path / "board")
    colift("season", "begin", "2027", "--board", board, "--no-own")
    again = colift("season", "begin", "2027", "--board", board, "--no-own")
    assert "already has a season 2027" in str(again.exception)
