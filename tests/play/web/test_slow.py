"""A page that takes nothing for a while: it loses old frames, and nobody waits for it."""

import asyncio
import json
import socket
import struct
import time

from colift.play.web.page import Page
from colift.play.web.processes import SmallBuffers
from fastapi import FastAPI, WebSocket
from websockets.sync.client import connect

from ...serving import serving

FRAMES = 20_000


def sending(found):
    """Return an application that sends a page frames as fast as it can."""
    app = FastAPI()

    @app.websocket("/")
    async def frames(websocket: WebSocket) -> None:
        await websocket.accept()
        page = Page(websocket)
        serving = asyncio.create_task(page.serve(lambda message: None))
        page.say("start")
        for number in range(FRAMES):
            page.send(struct.pack("<I24x", number))
            if number % 20 == 0:
                await asyncio.sleep(0)
        found["sent"] = True
        page.say("end")
        await serving
        found["dropped"] = page.dropped

    return app


def test_a_page_that_reads_late_gets_the_newest_frames_and_all_sentences():
    found, read = {}, []
    with serving(sending(found), sockets=SmallBuffers) as url:
        narrow = socket.socket()
        narrow.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        narrow.connect(("127.0.0.1", int(url.rpartition(":")[2])))
        place = url.replace("http://", "ws://") + "/"
        with connect(place, sock=narrow, compression=None, max_queue=1) as page:
            # Whoever waited for the page would wait here: it reads nothing yet.
            end = time.monotonic() + 120
            while "sent" not in found:
                assert time.monotonic() < end
                time.sleep(0.05)
            while not read or read[-1] != {"type": "end"}:
                message = page.recv(60)
                read.append(
                    json.loads(message)
                    if isinstance(message, str)
                    else struct.unpack_from("<I", message)[0]
                )
    numbers = read[1:-1]
    assert read[0] == {"type": "start"}
    assert numbers == sorted(numbers)
    assert numbers[-1] == FRAMES - 1
    assert len(numbers) + found["dropped"] == FRAMES
    assert found["dropped"] > FRAMES / 2  # Few wait in the buffers of the system.
