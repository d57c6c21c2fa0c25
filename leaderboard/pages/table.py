"""The table of pages: those of all modules of ``views``, by name."""

from collections.abc import Iterable, Iterator, Mapping
from importlib import import_module
from pkgutil import iter_modules
from typing import Final

from colift.leaderboard import views
from colift.leaderboard.views.page import Page


def _rows() -> Iterator[Page]:
    for each in iter_modules(views.__path__):
        yield from getattr(import_module(f"{views.__name__}.{each.name}"), "PAGES", ())


def by_name(pages: Iterable[Page]) -> Mapping[str, Page]:
    """Return pages by name.

    Raises
    ------
    ValueError
        If two have one name.
    """
    found: dict[str, Page] = {}
    for page in pages:
        if found.setdefault(page.name, page) is not page:
            raise ValueError(f"two pages have the name {page.name!r}: {found[page.name]}, {page}")
    return found


PAGES: Final = by_name(_rows())
"""All pages: ``PAGES`` of each module of ``views``."""

NAVIGATION: Final = sorted(
    (page for page in PAGES.values() if page.menu), key=lambda page: (page.place, page.menu)
)
"""The pages of the navigation, in their order."""
