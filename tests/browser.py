"""A real browser without a window."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Protocol

import pytest
from axe_core_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, expect, sync_playwright

expect.set_options(timeout=60_000)  # A machine may be busy; no test is about time.

NAMES = ("chromium", "chromium-browser", "google-chrome")

HEADLESS = "chromium-headless-shell"
"""Chromium without its windows: a page takes less time in it. It crashes when a mouse is locked."""

OPTIONS = (
    "--no-sandbox",
    "--disable-features=WebUIOmniboxPopup,WebUIOmniboxAimPopup,HttpsUpgrades,MediaRouter,"
    "OptimizationHints,PaintHolding,ThirdPartyStoragePartitioning",
)
"""Options of a browser.

Chromium draws the lists below the address bar as two more pages for each window, seen or not: they
take three times as long as the page itself. Of Playwright's own list of features, which this one
replaces, it has what concerns pages.
"""


class Installed(Protocol):
    """A kind of browser of either of Playwright's interfaces."""

    @property
    def executable_path(self) -> str: ...


def chromium_path(chromium: Installed, locks: bool = False) -> str | None:
    """Return the system's Chromium; None for the one that Playwright has installed.

    ``locks`` asks for one that locks the mouse.
    """
    names = NAMES if locks else (HEADLESS, *NAMES)
    path = next(filter(None, map(shutil.which, names)), None)
    if path is None and not Path(chromium.executable_path).exists():
        pytest.skip("needs a browser: apt-get install chromium, or playwright install chromium")
    return path


@contextmanager
def browser(locks: bool = False) -> Iterator[Browser]:
    """Yield the system's Chromium, or the one that Playwright has installed."""
    with sync_playwright() as playwright:
        path = chromium_path(playwright.chromium, locks)
        opened = playwright.chromium.launch(executable_path=path, args=list(OPTIONS))
        yield opened
        opened.close()


def violations(page: Page, options: dict[str, Any] | None = None) -> list[tuple[str, str]]:
    """Return what axe-core finds in a page: the rule, and the beginning of the element."""
    found = Axe().run(page, options=options)["violations"]
    return [(each["id"], node["html"][:200]) for each in found for node in each["nodes"][:3]]
