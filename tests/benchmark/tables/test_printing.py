"""Tables in a terminal: whole words, all columns, captions within the width."""

import io

from colift.benchmark.tables.printing import counted, left, show, table
from rich.console import Console


def printed(*parts, width=80):
    file = io.StringIO()
    show(*parts, console=Console(file=file, width=width))
    return file.getvalue().splitlines()


def test_a_table_that_does_not_fit_keeps_its_columns_and_words():
    titles = ("human", *(f"metric {i} mm" for i in range(8)))
    rows = [("changing_goal", *["123.45"] * 8), ("smooth", *["1.2"] * 8)]
    lines = printed(table("Long", titles, rows, caption="word " * 40))
    heading, goal, smooth = lines[2], lines[4], lines[5]
    assert all(title in heading for title in titles)
    assert goal.split() == [*rows[0]]
    assert smooth.split() == [*rows[1]]
    assert max(map(len, lines[6:])) <= 80


def test_a_table_that_fits_is_not_wider_and_folds_its_words():
    rows = [("smooth", "1.2", "many words that wrap at some width, as they should in a terminal")]
    lines = printed(table("", ("human", "RMSE mm", left("words")), rows), width=50)
    assert max(map(len, lines)) <= 50
    assert len(lines) > 4


def test_a_long_name_is_folded_before_a_table_grows():
    lines = printed(table("", ("policy", "RMSE mm"), [("x" * 200, "1.2")]), width=40)
    assert max(map(len, lines)) <= 40
    assert sum(line.count("x") for line in lines) == 200


def test_one_thing_is_counted_in_the_singular():
    assert [counted(number, "lift") for number in (0, 1, 2)] == ["0 lifts", "1 lift", "2 lifts"]
