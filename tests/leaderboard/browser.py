"""A real browser without a window."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from playwright.sync_api import Browser, sync_playwright

NAMES = ("chromium", "chromium-browser", "google-chrome")
WITHOUT = "COLIFT_TESTS_WITHOUT_BROWSER"
"""If this is set in the environment, tests that need a browser are skipped."""


@contextmanager
def browser() -> Iterator[Browser]:
    """Yield the system's Chromium, or the one that Playwright has installed."""
    if os.environ.get(WITHOUT):
        pytest.skip(f"{WITHOUT} is set")
    path = next(filter(None, map(shutil.which, NAMES)), None)
    with sync_playwright() as playwright:
        opened = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield opened
        opened.close()
