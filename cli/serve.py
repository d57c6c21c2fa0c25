"""``colift serve``: a board on the web, and the workers that evaluate its submissions."""

import errno
import logging
import signal
import socket
import sys
from types import FrameType
from typing import Annotated

import typer

from ..agents.errors import InputError
from ..agents.extras import how_to_install
from ..agents.sandbox.host.levels import check_level
from ..agents.submissions.folder import MIB
from ..benchmark.execution.pool import default_jobs
from ..leaderboard.evaluation.entrant import AUTO
from ..leaderboard.queue import Quota
from .board_options import BOARD, BoardFolder, BoardIsolation

ENDING = (signal.SIGINT, signal.SIGTERM)
"""Signals that end the service."""


def serve_board(
    board: BoardFolder = BOARD,
    host: Annotated[
        str,
        typer.Option(
            metavar="ADDRESS", help="Address to listen on; 0.0.0.0: all of this machine's."
        ),
    ] = "127.0.0.1",
    port: Annotated[
        int, typer.Option(metavar="N", min=0, max=65535, help="Port to listen on; 0: any free one.")
    ] = 8000,
    workers: Annotated[
        int, typer.Option(metavar="N", min=0, help="Processes that evaluate submissions.")
    ] = 1,
    isolation: BoardIsolation = AUTO,
    rows_a_day: Annotated[
        int,
        typer.Option(metavar="N", min=1, help="Rows per submitter in 24 hours."),
    ] = Quota().rows,
    kept: Annotated[
        int,
        typer.Option(metavar="MIB", min=1, help="Size of the files kept per submitter, in MiB."),
    ] = Quota().size // MIB,
    contact: Annotated[
        str,
        typer.Option(metavar="TEXT", help="How to reach you; shown on the submission page."),
    ] = "",
    docs: Annotated[
        str,
        typer.Option(
            metavar="URL_OR_FOLDER",
            help="Documentation to link to: an address, or a folder to serve under /docs/.",
        ),
    ] = "",
    root: Annotated[
        str,
        typer.Option(metavar="/PATH", help="Path of the board behind a reverse proxy."),
    ] = "",
) -> None:
    """Serve a board on the web: its pages, its JSON interface, and uploads."""
    try:
        from ..leaderboard.service.app import create_app
        from ..leaderboard.service.documentation import Documentation
        from ..leaderboard.service.server import make_server, running
    except ModuleNotFoundError as error:
        raise InputError(
            f"{error.name} is not installed; a board on the web needs: {how_to_install('board')}"
        ) from error
    documentation = Documentation.at(docs) if docs else None
    quota = Quota(rows=rows_a_day, size=kept * MIB)
    if isolation != AUTO:
        check_level(isolation)  # Rather than by each worker, again and again.
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s %(levelname)s %(message)s")
    command = [sys.executable, "-m", "colift.cli", "worker", "--board", str(board.absolute())]
    command += ["--jobs", str(max(1, default_jobs() // max(1, workers)))]  # They share the cores.
    command += ["--isolation", isolation]
    for number in ENDING:
        signal.signal(number, _leave)  # uvicorn raises it again after closing.
    try:
        with _listening(host, port) as listener:
            app = create_app(board, contact=contact, quota=quota, docs=documentation)
            server = make_server(app, root.rstrip("/"))
            with running(command, workers):
                print(f"Board {board}: {_url(listener)} (Ctrl-C ends it)", flush=True)
                server.run(sockets=[listener])
    except KeyboardInterrupt:
        pass  # Requested, and done.


def _listening(host: str, port: int) -> socket.socket:
    """Return a listening socket.

    Raises
    ------
    InputError
        If the address or the port cannot be used.
    """
    from ..leaderboard.service.server import listening

    try:
        return listening(host, port)
    except OSError as error:
        reason = {
            errno.EADDRINUSE: f"port {port} is taken; choose another by --port (0: any free one)",
            errno.EACCES: f"port {port} needs more rights; choose one above 1023 by --port",
            errno.EADDRNOTAVAIL: "this machine has no such address; 127.0.0.1 and 0.0.0.0 are",
        }.get(error.errno or 0, error.strerror)
        raise InputError(f"cannot listen on {host}:{port}: {reason}") from error


def _url(listener: socket.socket) -> str:
    host, port = listener.getsockname()[:2]
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


def _leave(number: int, frame: FrameType | None) -> None:
    for each in ENDING:
        signal.signal(each, signal.SIG_IGN)  # A second one would cut the workers' last seconds.
    raise KeyboardInterrupt
