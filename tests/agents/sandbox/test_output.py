"""What a policy prints is kept: its end, and nothing that a terminal obeys."""

import os

import pytest
from colift.agents.sandbox.host.output import Output, clean


@pytest.fixture
def pipe():
    reading, writing = os.pipe()
    output = Output(reading)
    yield output, writing
    output.close()
    os.close(writing)


def test_nothing_printed_is_an_empty_text(pipe):
    assert pipe[0].text == ""


@pytest.mark.parametrize("letter", ["x", "é", "漢", "🤖"])
def test_the_last_ten_thousand_characters_are_kept(pipe, letter):
    output, writing = pipe
    for part in range(30):
        os.write(writing, (f"<{part}>" + letter * 1000).encode())
        output.drain()
    text = output.text
    assert len(text) == 10_000
    assert text.endswith("<29>" + letter * 1000)
    assert "<20>" not in text


def test_a_character_cut_in_two_is_no_error(pipe):
    output, writing = pipe
    os.write(writing, "é".encode()[:1])
    assert output.text == "\N{REPLACEMENT CHARACTER}"


def test_what_came_before_the_close_is_there_after_it(pipe):
    output, writing = pipe
    os.write(writing, b"last words")
    output.close()
    assert output.text == "last words"


def test_reading_is_bounded_while_writing_goes_on(pipe):
    output, writing = pipe
    os.set_blocking(writing, False)
    written = 0
    for _ in range(200):
        try:
            written += os.write(writing, b"y" * 65536)
        except BlockingIOError:
            output.drain()
    assert written > 1_000_000
    assert output.text == "y" * 10_000


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("plain\ttext\n", "plain\ttext\n"),
        ("\x1b[31mred\x1b[0m", "red"),
        ("\x1b]0;title\x07", "]0;title"),
        ("a\rb\x00c\x7fd\x9be", "abcde"),
        ("right\u202eleft", "rightleft"),
        ("half\udc80", "half?"),
        ("is\u2066ol\u2067at\u2068es\u2069", "isolates"),
        ("ma\u200erk\u200fs\u061c", "marks"),
        ("un\u200bse\u00aden\ufeff", "unseen"),
        ("t\U000e0041ag, pri\ue000vate, no\uffffne", "tag, private, none"),
        ("a line\u2028one\u2029", "a lineone"),
        ("漢字 é 🤖", "漢字 é 🤖"),
    ],
)
def test_what_a_terminal_would_obey_is_taken_out(text, kept):
    assert clean(text) == kept
