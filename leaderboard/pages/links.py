"""Addresses of the pages: at the service, and in a folder of files."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Final
from urllib.parse import quote

from colift.leaderboard.pages.table import PAGES
from colift.leaderboard.views.page import Page

STATIC: Final = (("colift.benchmark.rendering", "static"), ("colift.leaderboard", "static"))
"""The packages and their folders with the styles, scripts and images of the pages."""


@dataclass(frozen=True)
class Links:
    """The addresses of a service; or, with ``current``, the files of a site.

    ``links.NAME(...)`` is the address of the page of that name, from the parts of its address in
    their order; empty if there is no such page here.
    """

    root: str = ""
    """Path below which a service is served, without a slash at its end."""
    documentation: str = ""
    """Address of the documentation, if there is one."""
    lifting: str = ""
    """Address of live lifts, if there are any."""
    current: str = ""
    """Name of the season whose table is the front page of the site."""

    @property
    def live(self) -> bool:
        """Whether the board takes submissions: a service does, files do not."""
        return not self.current

    def to(self, page: Page, *values: str) -> str:
        """Return the address of a page with some values for its parts."""
        form = page.url if self.live else page.file
        if not form:
            return ""
        shown = zip(page.parts, map(quote, values) if self.live else values, strict=True)
        address = form.format(**dict(shown))
        return f"{self.root}{address}" if self.live else address

    def of_season(self, page: Page, season: str) -> str:
        """Return the address of a page of the navigation for the readers of a season."""
        return self.to(page, *(season for _ in page.parts))

    def __getattr__(self, name: str) -> Callable[..., str]:
        """Return the addresses of a page."""
        if name not in PAGES:
            raise AttributeError(f"there is no page {name!r}; pages: {', '.join(sorted(PAGES))}")
        return partial(self.to, PAGES[name])

    def board(self, season: str | None = None) -> str:
        """Return the address of the table of a season; by default the front page."""
        front = season in (None, self.current)
        return self.to(PAGES["front"]) if front else self.to(PAGES["season"], str(season))

    def docs(self, page: str = "") -> str:
        """Return the address of the documentation, or of one of its pages; nothing without one."""
        if not (self.documentation and page):
            return self.documentation
        return f"{self.documentation.removesuffix('index.html').rstrip('/')}/{page}.html"

    def play(self) -> str:
        """Return the address of live lifts; nothing without any."""
        return self.lifting

    def asset(self, name: str) -> str:
        """Return the address of a style, a script or an image."""
        return f"{self.root}/static/{name}" if self.live else f"static/{name}"
