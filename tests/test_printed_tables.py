"""The tables of recorded outputs, as the documentation reads them back."""

import importlib.util
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FIGURES = sorted((ROOT / "docs" / "figures").glob("*.txt"))

spec = importlib.util.spec_from_file_location(
    "printed_tables", ROOT / "docs/extensions/printed_tables.py"
)
printed_tables = importlib.util.module_from_spec(spec)
spec.loader.exec_module(printed_tables)


def read(text):
    return list(printed_tables.read_output(text))


@pytest.mark.parametrize("path", FIGURES, ids=lambda path: path.stem)
def test_no_word_of_a_recorded_output_is_lost_or_invented(path):
    text = path.read_text()
    found = [
        word
        for part in read(text)
        for words in ([part] if isinstance(part, str) else [*part.head, *sum(part.rows, ())])
        for word in words.split()
    ]
    printed = re.sub(r"^ ─+$", "", text, flags=re.MULTILINE)
    assert sorted("".join(found)) == sorted("".join(printed.split()))


def test_a_folded_name_is_whole_and_numbers_are_told_from_words():
    text = (
        "2 policies on late-v1\n\n"
        "  #  policy         RMSE mm  limit\n"
        " ──────────────────────────────────\n"
        "  1  blend,            13.5  kept\n"
        "      forgetting=1\n"
        "     two people         9.4  none\n\n"
        "All lifts.\n"
    )
    title, table, words = read(text)
    assert (title, words) == ("2 policies on late-v1", "All lifts.")
    assert table.head == ("#", "policy", "RMSE mm", "limit")
    assert table.rows[0] == ("1", "blend,forgetting=1", "13.5", "kept")
    assert table.numeric == (True, False, True, False)


def test_a_table_may_have_sections_and_names_that_are_set_in():
    text = (
        "                  suite\n ──────────────────────\n  beating people      7\n"
        "    Spearman       0.89\n\n  all                12\n"
    )
    (table,) = read(text)
    assert [row[0] for row in table.rows] == ["beating people", "\u2003Spearman", "all"]


def test_the_lines_of_a_list_are_not_joined_and_folded_sentences_are():
    folded = " ".join(["word"] * 24)
    assert read(f"a: one\nb: two\n{folded}\nfolded.\n") == ["a: one", "b: two", f"{folded} folded."]


def test_a_line_without_a_row_is_an_error():
    with pytest.raises(ValueError, match="begins with the line"):
        read("  a  b  c\n ───────\n  1\n")
