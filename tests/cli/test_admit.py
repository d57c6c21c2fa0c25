"""``colift admit`` as a user meets it: what it refuses, and what it prints of a small suite."""

import pytest


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["intent-v1", "--pairs", "1"], "--pairs must be 2 to 20, or 0 for none; got 1"),
        (
            ["standard-v1", "--pairs", "2"],
            "pairs can be trained for tasks with touch; 'level' has none",
        ),
        (["nothing"], "unknown suite 'nothing'"),
    ],
)
def test_what_it_cannot_do_is_refused_in_one_line(colift, arguments, words):
    done = colift("admit", *arguments)
    assert done.returncode == 2
    assert words in " ".join(done.stderr.split())
    assert "Traceback" not in done.stderr
