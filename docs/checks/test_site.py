"""The built site in a browser: search finds what explains first, and everybody can read a page."""

import functools
import threading
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from tests.browser import browser, violations

SITE = Path(__file__).parents[2] / "site"

SAMPLES = {
    "generated/api": ("colift", "colift.benchmark.environment.parallel"),
    "generated/commands": ("run", "nao"),
    "generated/gallery": ("index", "plot_policy"),
}
"""Pages that stand for all of their folder, which are made alike."""

LISTS = {"genindex", "py-modindex", "sg_execution_times"}
"""Lists of Sphinx's own, to which no page leads."""

WIDE, PHONE = {"width": 1280, "height": 900}, {"width": 390, "height": 844}

LAID_OUT = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
"""Ends after the page has heard of its new size."""


def pages():
    """Return the pages, relative to the site."""
    found = sorted(str(path.relative_to(SITE).with_suffix("")) for path in SITE.rglob("*.html"))
    written = [
        each for each in found if not each.startswith(("_", "generated/")) and each not in LISTS
    ]
    return [*written, *(f"{folder}/{name}" for folder, names in SAMPLES.items() for name in names)]


class Quiet(SimpleHTTPRequestHandler):
    """Files of a folder, without a log."""

    def log_message(self, *arguments):
        pass


@pytest.fixture(scope="module")
def address():
    with ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=SITE)) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


@pytest.fixture(scope="module")
def page():
    with browser() as opened:
        yield opened.new_page()


def found(page, address, words):
    """Return the pages that a search finds, the first one first."""
    page.goto(f"{address}/search.html?q={words}")
    page.locator("#search-results li").first.wait_for()
    page.get_by_text("Search finished").wait_for()
    links = page.locator("#search-results li > a:first-child")
    return links.evaluate_all("all => all.map((each) => new URL(each.href).pathname)")


@pytest.mark.parametrize(
    ("words", "first"),
    [
        ("latency", "/reference/environment.html"),
        ("observation", "/reference/environment.html"),
        ("submit", "/guides/submissions.html"),
        ("recordings", "/reference/files.html"),
        ("training", "/guides/training.html"),
        ("sandbox", "/guides/sandbox.html"),
    ],
)
def test_search_finds_the_page_that_explains_before_the_names_of_the_code(
    page, address, words, first
):
    results = found(page, address, words)
    assert results[0] == first
    code = [place for place, each in enumerate(results) if each.startswith("/generated/api/")]
    assert code == list(range(len(results) - len(code), len(results)))


def test_search_finds_a_name_of_the_code(page, address):
    assert found(page, address, "MotionFilter")[0].startswith("/generated/api/")


@pytest.mark.parametrize("name", pages())
def test_everybody_can_read_a_page(page, address, name):
    """Nothing for axe-core, in light and dark; on a telephone, what scrolls is reached by keys."""
    page.set_viewport_size(WIDE)
    page.emulate_media(color_scheme="light", reduced_motion="reduce")
    page.goto(f"{address}/{name}.html")
    assert violations(page) == []
    page.emulate_media(color_scheme="dark", reduced_motion="reduce")
    assert violations(page, {"runOnly": ["color-contrast"]}) == []
    page.set_viewport_size(PHONE)
    page.evaluate(LAID_OUT)
    assert violations(page, {"runOnly": ["scrollable-region-focusable"]}) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
