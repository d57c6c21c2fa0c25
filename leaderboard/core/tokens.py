"""Submitters' tokens, of which the board stores only hashes."""

import hashlib
import re
import secrets
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Final

import sqlalchemy as sa
from colift.base.errors import InputError
from colift.leaderboard.core.board import BUILTIN, LOCAL, Board
from colift.leaderboard.database.schema import tokens

NAME: Final = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.@+-]{0,63}")
"""Pattern of a submitter's name."""

PREFIX: Final = "colift_"
"""Prefix of a token, by which a leaked one is recognised."""


@dataclass(frozen=True, kw_only=True)
class TokenInfo:
    """The facts about a token, without the token itself."""

    name: str
    added_at: datetime
    revoked_at: datetime | None


@dataclass(frozen=True)
class Tokens:
    """The tokens of a board."""

    board: Board

    def add(self, name: str) -> str:
        """Return a new token for a submitter; see :meth:`add_all`."""
        return self.add_all([name])[name]

    def add_all(self, names: Sequence[str]) -> dict[str, str]:
        """Return a new token for each submitter: 256 random bits, which cannot be shown again.

        Raises
        ------
        InputError
            If a name is malformed, there twice, or has a token that was not revoked; then nobody
            gets one.
        """
        for name in names:
            if not NAME.fullmatch(name) or name in (LOCAL, BUILTIN):
                raise InputError(
                    f"{name!r} must be letters A to Z, digits and _.@+-, at most 64, not {LOCAL} "
                    f"or {BUILTIN}"
                )
            if names.count(name) > 1:
                raise InputError(f"{name} is named twice; a submitter has one token")
        made = {name: PREFIX + secrets.token_urlsafe(32) for name in names}
        with self.board.database.writing() as connection:
            for name, token in made.items():
                if connection.scalar(sa.select(tokens.c.number).where(_active(name))) is not None:
                    raise InputError(f"{name} has a token; revoke it first")
                connection.execute(
                    sa.insert(tokens).values(
                        name=name, sha256=_hash(token), added_at=self.board.clock()
                    )
                )
        return made

    def revoke(self, name: str) -> None:
        """Revoke a submitter's token, effective at once.

        Raises
        ------
        InputError
            If the submitter has none.
        """
        with self.board.database.writing() as connection:
            done = connection.execute(
                sa.update(tokens).where(_active(name)).values(revoked_at=self.board.clock())
            )
            if not done.rowcount:
                raise InputError(f"{name!r} has no token on {self.board.folder}")

    def submitter(self, token: str) -> str | None:
        """Return the owner of a token, or None if it is not valid."""
        valid = (tokens.c.sha256 == _hash(token)) & tokens.c.revoked_at.is_(None)
        with self.board.database.reading() as connection:
            name: str | None = connection.scalar(sa.select(tokens.c.name).where(valid))
        return name

    def all(self) -> tuple[TokenInfo, ...]:
        """Return the facts about all tokens, oldest first."""
        table = tokens.c
        query = sa.select(table.name, table.added_at, table.revoked_at).order_by(table.number)
        with self.board.database.reading() as connection:
            return tuple(TokenInfo(**found) for found in connection.execute(query).mappings())


def _active(name: str) -> sa.ColumnElement[bool]:
    return (tokens.c.name == name) & tokens.c.revoked_at.is_(None)


def _hash(token: str) -> str:
    return hashlib.sha256(token.encode(errors="surrogateescape")).hexdigest()
