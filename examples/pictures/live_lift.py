"""A picture of a live lift: ``colift play`` in a browser, with keys that move the hand to the goal.

It needs the extra ``board``, Playwright and Chromium::

    python live_lift.py blend play.png
"""

import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

from playwright.sync_api import Page, sync_playwright

SIZE = {"width": 1180, "height": 720}


def lift(page: Page, partner: str) -> None:
    """Choose a partner, hold the table, wait for the goal, and go on the way to it."""
    page.locator(f'input[name="partner"][value="{partner}"]').check()
    page.locator('input[name="consent"]').check()
    page.get_by_role("button", name="To the table").click()
    page.get_by_role("button", name="Lift", exact=True).wait_for()
    page.locator("#stage").focus()
    page.keyboard.press("Space")
    page.locator(".play-goal:not(.none)").wait_for(state="attached")
    page.keyboard.down("ArrowUp")
    page.wait_for_timeout(800)


@contextmanager
def served(partner: str) -> Iterator[str]:
    """Serve live lifts with a partner, and yield the address of the page."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["colift", "play", partner, "--no-browser", "--port", "0", "--out", folder]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
            try:
                lines = server.stdout or ()
                yield next(found[0] for each in lines if (found := re.search(r"http://\S+", each)))
            finally:
                server.terminate()


def main(partner: str, file: str) -> None:
    """Take the picture."""
    with served(partner) as address, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"))
        page = browser.new_page(viewport=SIZE, color_scheme="light", device_scale_factor=1.5)
        page.set_default_timeout(120_000)  # A lift begins only on a machine with time for it.
        page.goto(address)
        lift(page, partner)
        page.screenshot(path=file)
        browser.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
