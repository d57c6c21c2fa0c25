"""A page without a browser: its socket, its clock, and a hand that follows the cues."""

import json
import struct
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any

import pytest
from colift.play.web.app import create_play
from colift.play.web.keeper import PlayConfig
from colift.play.web.processes import SmallBuffers
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from ... import web
from ...serving import serving

GRIP = {"offset": 0.0, "playout": 20, "rtt": 1, "input": {"preset": "mouse"}}
"""The room's clock and the test's are the same one."""

MOVING_S = 0.8
"""Time of a movement from one height to the next [s]."""


async def never_busy() -> None:
    """Stand for a machine with time: this one may have others' work."""


def playing(
    config: PlayConfig, obstacle: Callable[..., Any] = never_busy
) -> AbstractContextManager[str]:
    """Serve live lifts; the context is their address."""
    return serving(create_play(config, obstacle=obstacle), sockets=SmallBuffers)


def new_session(url: str) -> tuple[str, str]:
    """Make a session; return its name and the host's secret."""
    answer = web.post(f"{url}/api/sessions").raise_for_status().json()
    return answer["session"], answer["secret"]


def open_socket(url: str, origin: str | None = "ours") -> ClientConnection:
    """Open a socket, as a page of that origin would; None: no page."""
    place = url.replace("http://", "ws://")
    asked = url.removesuffix("/play") if origin == "ours" else origin
    return connect(f"{place}/socket", origin=asked, compression=None, max_queue=None)


class Page:
    """A page that has joined."""

    def __init__(self, url: str, session: str, secret: str, seat: int | str = 0) -> None:
        self.socket = open_socket(url).__enter__()
        self.frames: list[bytes] = []
        self.told: list[dict[str, Any]] = []
        self.say("join", session=session, secret=secret, seat=seat)

    def __enter__(self) -> "Page":
        return self

    def __exit__(self, *_: object) -> None:
        self.socket.close()

    def say(self, kind: str, /, **content: Any) -> None:
        self.socket.send(json.dumps({"type": kind, **content}))

    def next(self, timeout: float = 30.0) -> dict[str, Any] | None:
        """Return the next control message; None for a frame."""
        message = self.socket.recv(timeout)
        if isinstance(message, bytes):
            self.frames.append(message)
            return None
        content = json.loads(message)
        self.told.append(content)
        return content

    def until(self, *kinds: str, timeout: float = 30.0, **wanted: Any) -> dict[str, Any]:
        """Return the next control message of a kind, with those values."""
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            content = self.next(max(end - time.monotonic(), 0.01))
            if content and content["type"] in kinds and wanted.items() <= content.items():
                return content
        raise TimeoutError(f"no {kinds} {wanted}; got {self.told}")

    def closed(self, timeout: float = 20.0) -> int:
        """Return the code by which the socket is closed."""
        try:
            while True:
                self.next(timeout)
        except ConnectionClosed as end:
            return end.rcvd.code if end.rcvd else 1006

    def lifted(self, tries: int = 5) -> dict[str, Any]:
        """Lift until a lift counts: on a busy machine the first may be void, or all."""
        for _ in range(tries):
            end = self.lift()
            if end["type"] == "end":
                return end
            self.ready()
        assert "too busy" in end["reason"]
        pytest.skip(f"{tries} lifts were void: {end['reason']}")

    def ready(self) -> dict[str, Any]:
        """Wait until there is a room that is ready."""
        return self.until("state", phase="ready")

    def lift(self) -> dict[str, Any]:
        """Close the hand, follow the cues, and return how the lift ended."""
        self.say("grip", **GRIP)
        start = self.until("start")
        begin, last = start["at"], (0.0, 0.0, 0.0)
        sent = 0
        while True:
            now = 1000 * time.monotonic()
            began, old, new = last
            part = min(max((now - began) / (1000 * MOVING_S), 0.0), 1.0)
            height = old + (new - old) * part**3 * (10 - 15 * part + 6 * part**2)
            self.socket.send(samples(sent, [(now, height)]))
            sent += 1
            due = time.monotonic() + 1 / 60
            while (left := due - time.monotonic()) > 0:
                try:
                    content = self.next(left)
                except TimeoutError:
                    break
                if content is None:
                    continue
                if content["type"] == "cue":
                    last = (begin + 10 * content["frame"] + 250, height, content["height"])
                elif content["type"] in ("end", "void", "room_lost"):
                    return content


def samples(first: int, values: list[tuple[float, float]]) -> bytes:
    """Return a message with samples: time of the page's clock [ms], height [m]."""
    return struct.pack("<BI", 1, first) + b"".join(struct.pack("<df", *each) for each in values)
