"""An application that serves on loopback, from a thread of the test's process."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from colift.leaderboard.service.server import listening, make_server
from fastapi import FastAPI


@contextmanager
def serving(app: FastAPI, *options: Any, **more: Any) -> Iterator[str]:
    """Serve an application as ``make_server`` does with these options; yield its address."""
    listener = listening("127.0.0.1", 0)
    server = make_server(app, *options, **more)
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    try:
        yield "http://{}:{}".format(*listener.getsockname())
    finally:
        server.should_exit = True
        thread.join()
        listener.close()
