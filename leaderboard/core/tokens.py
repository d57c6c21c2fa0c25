"""Submitters' tokens, of which the board stores only hashes."""

import hashlib
import re
import secrets
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
        """Return a new token for a submitter: 256 random bits, which cannot be shown again.

        Raises
        ------
        InputError
            If the name is malformed, or has a token that was not revoked.
        """
        if not NAME.fullmatch(name) or name in (LOCAL, BUILTIN):
            raise InputError(
                f"{name!r} must be letters, digits and _.@+-, at most 64, not {LOCAL} or {BUILTIN}"
            )
        token = PREFIX + secrets.token_urlsafe(32)
        with self.board.database.writing() as connection:
            if connection.scalar(sa.select(tokens.c.number).where(_active(name))) is not None:
                raise InputError(f"{name} has a token; revoke it first")
            connection.execute(
                sa.insert(tokens).values(
                    name=name, sha256=_hash(token), added_at=self.board.clock()
                )
            )
        return token

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
