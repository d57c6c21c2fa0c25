"""A real browser without a window."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

import pytest
from playwright.sync_api import Browser, sync_playwright

NAMES = ("chromium", "chromium-browser", "google-chrome")


class Installed(Protocol):
    """A kind of browser of either of Playwright's interfaces."""

    @property
    def executable_path(self) -> str: ...


def chromium_path(chromium: Installed) -> str | None:
    """Return the system's Chromium; None for the one that Playwright has installed."""
    path = next(filter(None, map(shutil.which, NAMES)), None)
    if path is None and not Path(chromium.executable_path).exists():
        pytest.skip("needs a browser: apt-get install chromium, or playwright install chromium")
    return path


@contextmanager
def browser() -> Iterator[Browser]:
    """Yield the system's Chromium, or the one that Playwright has installed."""
    with sync_playwright() as playwright:
        path = chromium_path(playwright.chromium)
        opened = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield opened
        opened.close()
