"""The mark of a policy that is rougher than two people: on the site, in the terminal, in files."""

import dataclasses
import re

import pytest
from colift.benchmark.results.roughness import MEANING, ROUGHER, SIGN
from colift.cli.tables.board import board_table
from colift.leaderboard.core.board import Board
from colift.leaderboard.pages.site import write_site

from ..rows import add, digest


def rough(row):
    hidden = dataclasses.replace(row.hidden, rougher=("human_force_n", "rest_speed_mm_s"))
    return dataclasses.replace(row, hidden=hidden)


def calm(row):
    return dataclasses.replace(row, hidden=dataclasses.replace(row.hidden, rougher=()))


@pytest.fixture
def board(tmp_path):
    made = Board.open(tmp_path / "board", "quick-v1")
    add(made, "rough", 9.0, change=rough)
    add(made, "calm", 12.0, change=calm)
    add(made, "older", 13.0)
    yield made
    made.close()


def test_the_mark_and_its_meaning_are_on_the_table_and_on_the_row_s_page(board, tmp_path):
    write_site(board, tmp_path / "site")
    table = (tmp_path / "site" / "index.html").read_text()
    named = dict(
        re.findall(r'<th role="rowheader"[^>]*><a[^>]*>(\w+)</a>(.*?)<small>', table, re.S)
    )
    assert {name: ROUGHER in flags for name, flags in named.items()} == {
        "rough": True, "calm": False, "older": False,
    }  # fmt: skip
    assert MEANING in table
    page = (tmp_path / "site" / f"policy-1-{digest('rough'):.16}.html").read_text()
    assert MEANING in page
    assert "by force and trembling" in page
    assert MEANING not in (tmp_path / "site" / f"policy-1-{digest('calm'):.16}.html").read_text()
    assert MEANING in (tmp_path / "site" / "method.html").read_text()


def test_it_is_beside_the_rank_in_the_terminal_and_in_the_data_frame(board):
    table = board_table(board.season_info(), board.standings(), None, 200)
    ranks = zip(table.columns[1].cells, table.columns[0].cells, strict=True)
    marked = {str(name): str(rank).endswith(SIGN) for name, rank in ranks}
    assert marked == {"rough": True, "calm": False, "older": False}
    assert f"{SIGN}: {ROUGHER}." in str(table.caption)
    told = board.ranking().set_index("name")["rougher"]
    assert told["rough"] == "human_force_n rest_speed_mm_s"
    assert told["calm"] == ""
