"""A page of a board: its address, its file, its view and its template, in one row of a table."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

from colift.leaderboard.client import API
from colift.leaderboard.core.board import Board
from colift.leaderboard.queue import Queue
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.views.asked import Asked

PARTS: Final[Mapping[str, str]] = {
    "season": r"[A-Za-z0-9][A-Za-z0-9_-]{0,39}",
    "digest": "[0-9a-f]{64}",
    "job": "[0-9a-f]{32}",
    "behaviour": ".+",
    "subject": ".+",
    "name": ".+",
    "number": "[0-9]+",
}
"""The parts that an address can have in braces, with the pattern of their values."""

NAME: Final = "colift"
"""Name of a board without another one."""

Content = Mapping[str, Any] | str | bytes
"""What a view returns: the values for its template by name, or the page itself.

Every template also gets the name of its page as ``page``, and the current ``season``. A view may
return others, and another ``template``.
"""


class NoPageError(Exception):
    """There is nothing at this address; the message says what is missing."""


@dataclass(frozen=True, kw_only=True)
class Visit:
    """What a page is made for: a request to a service, or a file of a site."""

    board: Board
    name: str = NAME
    """Name of the board on its pages."""
    asked: Asked = field(default_factory=Asked)
    """The question to a table."""
    chosen: Sequence[str] | None = None
    """The submissions that are asked for; None in a site, whose pages hold those of all answers."""
    origin: str = "../"
    """Begins the addresses in a file that is read elsewhere."""
    queue: Queue | None = None
    """The queue of a service."""
    address: str = ""
    """Address of the service, if it is known."""
    rules: Callable[[], object] = lambda: None
    """Returns the rules of the service."""
    document: Callable[[], dict[str, Any]] = dict
    """Returns the OpenAPI document of the service."""


@dataclass(frozen=True, kw_only=True)
class Page:
    """A row of the table of pages.

    Raises
    ------
    ValueError
        If the address has an unknown part, its file has others or no season, or a page of the
        navigation has another part than the season.
    """

    name: str
    """Name by which templates link to it: ``links.NAME(...)``, with the parts in their order."""
    url: str = ""
    """Its address at a service, with :data:`PARTS` in braces; empty if it is only in a site."""
    file: str = ""
    """Its file in a site; empty if it is only at a service."""
    view: Callable[..., Content] | None = None
    """Makes its content from a :class:`Visit` and the parts of its address, by their names; raises
    :class:`NoPageError`. None: something else answers, for example the JSON interface."""
    template: str = ""
    """File of ``pages/templates``."""
    meaning: str = ""
    """What it shows, for the list in the documentation."""
    menu: str = ""
    """Name in the navigation; empty if it is not there."""
    place: int = 45
    """Place in the navigation: lower numbers first."""
    media: str = "text/html"
    headers: Mapping[str, str] = field(default_factory=dict)
    """Further headers, with the parts of its address in braces."""

    def __post_init__(self) -> None:
        """Check the parts."""
        for part in self.parts:
            if part not in PARTS:
                raise ValueError(f"page {self.name!r}: {part!r} is none of {', '.join(PARTS)}")
        if self.file and self.parts != _parts(self.file):
            raise ValueError(f"page {self.name!r}: {self.url} and {self.file} need the same parts")
        if self.file and self.parts and self.parts[0] != "season":
            raise ValueError(
                f"page {self.name!r}: the first part of {self.file} must be {{season}}"
            )
        if self.menu and set(self.parts) - {"season"}:
            raise ValueError(f"page {self.name!r} is in the navigation: it can be of a season only")

    @property
    def parts(self) -> tuple[str, ...]:
        """The parts of its address, in their order."""
        return _parts(self.url or self.file)

    @property
    def served(self) -> bool:
        """Whether a service answers with it."""
        return self.view is not None and bool(self.url) and not self.url.startswith(f"{API}/")

    def fits(self, values: Mapping[str, str]) -> bool:
        """Return whether the values of its parts can be those of an address."""
        return all(re.fullmatch(PARTS[name], value) for name, value in values.items())


def _parts(form: str) -> tuple[str, ...]:
    return tuple(re.findall(r"{(\w+)", form))


def ordered_seasons(board: Board) -> tuple[SeasonInfo, ...]:
    """Return the seasons, the current one first, then the newest."""
    by_age = sorted(board.seasons(), key=lambda info: info.began_at, reverse=True)
    return tuple(sorted(by_age, key=lambda info: not info.current))


def find_season(board: Board, name: str | None = None) -> SeasonInfo:
    """Return the season of that name, by default the current one.

    Raises
    ------
    NoPageError
        If there is none.
    """
    for info in ordered_seasons(board):
        if name in (None, info.name):
            return info
    raise NoPageError(f"There is no season {name}.")
