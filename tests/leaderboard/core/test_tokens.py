"""Tokens: shown once, kept as hashes, worthless when revoked."""

import pytest
from colift.base.errors import InputError
from colift.leaderboard.core.tokens import Tokens


@pytest.fixture
def tokens(board):
    return Tokens(board)


def test_a_token_says_whose_it_is_until_it_is_revoked(tokens, clock):
    first, second = tokens.add("ada@lab.org"), tokens.add("grace")
    assert (tokens.submitter(first), tokens.submitter(second)) == ("ada@lab.org", "grace")
    began = clock.now
    clock.turn(days=1)
    tokens.revoke("ada@lab.org")
    assert (tokens.submitter(first), tokens.submitter(second)) == (None, "grace")
    told = [(each.name, each.added_at, each.revoked_at) for each in tokens.all()]
    assert told == [("ada@lab.org", began, clock.now), ("grace", began, None)]
    renewed = tokens.add("ada@lab.org")
    assert renewed != first
    assert (tokens.submitter(first), tokens.submitter(renewed)) == (None, "ada@lab.org")


def test_nobodys_token_is_nobodys(tokens):
    token = tokens.add("ada")
    for other in ("", "x", token[:-1], token + "x", "' OR 1=1 --", "\0", "\udcff", "ü" * 10_000):
        assert tokens.submitter(other) is None


def test_the_token_itself_is_nowhere(tmp_path):
    from colift.leaderboard.core.board import Board

    board = Board.open(tmp_path / "board", "quick-v1")
    token = Tokens(board).add("ada")
    board.close()
    found = [path.read_bytes() for path in board.folder.rglob("*") if path.is_file()]
    assert any(b"ada" in content for content in found)
    assert not any(token.encode() in content for content in found)


@pytest.mark.parametrize("name", ["", "a b", "x" * 65, "<b>", "local", "-x"])
def test_a_submitter_needs_a_name(tokens, name):
    with pytest.raises(InputError, match="must be letters"):
        tokens.add(name)


def test_a_course_gets_its_tokens_together_or_not_at_all(tokens):
    made = tokens.add_all(["ada", "grace"])
    assert {tokens.submitter(token): name for name, token in made.items()} == {
        "ada": "ada",
        "grace": "grace",
    }
    for names, told in (
        (["emmy", "Jörg Müller"], "'Jörg Müller' must be letters A to Z"),
        (["emmy", "ada"], "ada has a token; revoke it first"),
        (["emmy", "emmy"], "emmy is named twice"),
    ):
        with pytest.raises(InputError, match=told):
            tokens.add_all(names)
    assert [each.name for each in tokens.all()] == ["ada", "grace"]


def test_one_has_one_token_at_a_time(tokens):
    tokens.add("ada")
    with pytest.raises(InputError, match="ada has a token; revoke it first"):
        tokens.add("ada")
    with pytest.raises(InputError, match="'grace' has no token"):
        tokens.revoke("grace")
