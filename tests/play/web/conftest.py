"""A server of live lifts, and pages of it in a browser that report every error."""

import fcntl
from collections.abc import Callable, Iterator

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.play.web import keeper
from colift.play.web.keeper import PlayConfig
from playwright.sync_api import Browser, Page

from .browsing import start_patient_room
from .pages import playing

OpenPage = Callable[..., Page]


@pytest.fixture(autouse=True)
def one_at_a_time(shared_folder) -> Iterator[None]:
    """Let live lifts take turns: a browser that shares its processor is too late for a goal."""
    with (shared_folder / "live-lifts.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


@pytest.fixture(scope="module")
def sessions(tmp_path_factory):
    """The folder of the sessions."""
    return tmp_path_factory.mktemp("live")


@pytest.fixture(scope="module")
def url(sessions) -> Iterator[str]:
    """A server of live lifts with two policies."""
    policies = {name: PolicySpec(text=name) for name in ("hold", "copy")}
    about = {"hold": "Stands still.", "copy": "Follows."}
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(keeper, "start_room", start_patient_room)
        with playing(PlayConfig(folder=sessions, policies=policies, descriptions=about)) as found:
            yield found


@pytest.fixture
def open_page(chromium: Browser) -> Iterator[OpenPage]:
    """Return what opens an empty page; errors of its scripts and other hosts fail the test."""
    wrong: list[str] = []
    contexts = []

    def opened(**options) -> Page:
        context = chromium.new_context(reduced_motion="reduce", **options)
        contexts.append(context)
        return watched(context.new_page())

    def watched(page: Page) -> Page:
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.on("console", lambda told: wrong.append(told.text) if _bad(told) else None)
        page.on("request", lambda asked: "//127.0.0.1:" in asked.url or wrong.append(asked.url))
        return page

    opened.watched = watched
    yield opened
    for context in contexts:
        context.close()
    assert wrong == []


def _bad(told) -> bool:
    # That a request was refused is shown on the page; the browser writes it down, too.
    return told.type == "error" and "the server responded with a status of 4" not in told.text


@pytest.fixture
def page(open_page: OpenPage) -> Page:
    """A page on a desktop."""
    return open_page(viewport={"width": 1280, "height": 800})
