"""Pages of live lifts in a browser: what they send, what they show, and real input events."""

import multiprocessing
import socket
import time
from collections.abc import Callable
from typing import Any

from colift.play.rooms import process, punctuality
from colift.play.rooms.messages import parse_samples
from colift.play.rooms.process import RoomProcess, start_room
from colift.play.rooms.room import RoomConfig
from playwright.sync_api import Page, WebSocket, expect

PATIENCE_S = 60.0
"""These tests are about pages: a machine that has other work does not void their lifts [s]."""

WAIT_MS = 30_000


def _patient(connection: socket.socket, config: RoomConfig) -> None:
    punctuality.VOID_S = punctuality.VOID_SUM_S = PATIENCE_S  # type: ignore[misc]
    process._run(connection, config)


def start_patient_room(config: RoomConfig) -> RoomProcess:
    """Start a room as :func:`start_room` does, which does not void lifts for being late."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([start_room.__module__])
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    room = context.Process(target=_patient, args=(theirs, config), daemon=True)
    room.start()
    theirs.close()
    ours.setblocking(False)
    return RoomProcess(ours, room)


class Hand:
    """What a page has sent: control messages, and the samples of its hand."""

    def __init__(self, page: Page) -> None:
        self.messages: list[str] = []
        self.samples: list[tuple[float, float]] = []
        self.packets = 0
        page.on("websocket", self._listen)

    def _listen(self, opened: WebSocket) -> None:
        opened.on("framesent", self._take)

    def _take(self, payload: str | bytes) -> None:
        if isinstance(payload, str):
            self.messages.append(payload)
            return
        content = parse_samples(payload)
        if content.first == 0:
            self.samples = []
            self.packets = 0
        assert content.first == len(self.samples)
        self.samples += content.samples
        self.packets += 1


def enter(page: Page, url: str, partner: str = "hold") -> None:
    """Open the page, choose a partner, and wait until a lift may begin."""
    page.goto(url)
    page.locator(f'input[name="partner"][value="{partner}"]').check()
    to_the_table(page)
    wait_until_ready(page)


def to_the_table(page: Page) -> None:
    """Agree to be recorded, and go on."""
    page.get_by_label("I agree").check()
    page.get_by_role("button", name="To the table").click()


def wait_until_ready(page: Page) -> None:
    expect(page.locator("#touch, #lift").locator("visible=true")).to_have_count(1, timeout=WAIT_MS)


def wait_for_phase(page: Page, phase: str) -> None:
    expect(page.locator("body")).to_have_attribute("data-phase", phase, timeout=WAIT_MS)


def wait_for(page: Page, script: str, wanted: Callable[[Any], bool] = bool) -> Any:
    """Return the value of a script as soon as it is what is wanted."""
    end = time.monotonic() + WAIT_MS / 1000
    while not wanted(value := page.evaluate(script)):
        assert time.monotonic() < end, (script, value, page.locator("#status").inner_text())
        page.wait_for_timeout(20)
    return value


def wait_for_height(page: Page, hand: Hand, height: float) -> None:
    """Wait until the newest sample that the page has sent is at a height [m]."""
    end = time.monotonic() + WAIT_MS / 1000
    while not hand.samples or abs(hand.samples[-1][1] - height) > 1e-4:
        assert time.monotonic() < end, (height, hand.samples[-3:])
        page.wait_for_timeout(20)


def table(page: Page) -> tuple[float, float]:
    """Return both ends of the table as they are drawn [m above rest]."""
    human, robot = page.evaluate(
        "(() => { const { human, robot } = coliftPlay.page.stage.shown; return [human, robot]; })()"
    )
    return human, robot
