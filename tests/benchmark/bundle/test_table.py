"""Texts in a table."""

from colift.benchmark.bundle import one_line
from hypothesis import given
from hypothesis import strategies as st


@given(st.text(st.characters(), max_size=300))
def test_any_text_becomes_one_line_that_stays_as_it_is(text):
    line = one_line(text)
    assert line.isprintable()
    assert len(line) <= 1000
    assert one_line(line) == line
    line.encode()


def test_plain_text_is_kept():
    assert one_line("step 5: ValueError: à la\tcarte") == r"step 5: ValueError: à la\tcarte"
