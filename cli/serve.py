"""``colift serve``: the board on the web, and the workers that evaluate what is submitted."""

import errno
import logging
import signal
import socket
import sys
from pathlib import Path
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
from .board_isolation import Isolation

ENDING = (signal.SIGINT, signal.SIGTERM)
"""Signals that end the service."""


def serve_board(
    board: Annotated[
        Path, typer.Option(metavar="PATH", help="The board's folder; made if there is none.")
    ] = Path("board"),
    host: Annotated[
        str, typer.Option(help="Address to listen at; 0.0.0.0 is all of this machine.")
    ] = "127.0.0.1",
    port: Annotated[
        int, typer.Option(min=0, max=65535, help="Port to listen at; 0 is any free one.")
    ] = 8000,
    workers: Annotated[
        int, typer.Option(metavar="N", min=0, help="Processes that evaluate submissions.")
    ] = 1,
    isolation: Isolation = AUTO,
    rows_a_day: Annotated[
        int,
        typer.Option(metavar="N", min=1, help="Rows that a submitter may get in 24 hours."),
    ] = Quota().rows,
    kept: Annotated[
        int,
        typer.Option(metavar="MIB", min=1, help="Files that are kept of a submitter, in MiB."),
    ] = Quota().size // MIB,
    contact: Annotated[
        str,
        typer.Option(metavar="TEXT", help="How you are reached; shown where people submit."),
    ] = "",
    root: Annotated[
        str,
        typer.Option(metavar="/PATH", help="Path below which a reverse proxy shows the board."),
    ] = "",
) -> None:
    """Serve a board on the web: its pages, its JSON interface, and uploads."""
    try:
        from ..leaderboard.service.app import create_app
        from ..leaderboard.service.server import make_server, running
    except ModuleNotFoundError as error:
        raise InputError(
            f"{error.name} is not installed; a board on the web needs: {how_to_install('board')}"
        ) from error
    quota = Quota(rows=rows_a_day, size=kept * MIB)
    if isolation != AUTO:
        check_level(isolation)  # Rather than by each worker, again and again.
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s %(levelname)s %(message)s")
    command = [sys.executable, "-m", "colift.cli", "worker", "--board", str(board.absolute())]
    command += ["--jobs", str(max(1, default_jobs() // max(1, workers)))]  # They share the cores.
    command += ["--isolation", isolation]
    for number in ENDING:
        signal.signal(number, _leave)  # uvicorn raises it again when all is closed.
    try:
        with _listening(host, port) as listener:
            server = make_server(create_app(board, contact=contact, quota=quota), root.rstrip("/"))
            with running(command, workers):
                print(f"Board {board}: {_url(listener)} (Ctrl-C ends it)", flush=True)
                server.run(sockets=[listener])
    except KeyboardInterrupt:
        pass  # Asked for, and done.


def _listening(host: str, port: int) -> socket.socket:
    """Return a socket that is listened at.

    Raises
    ------
    InputError
        If that is not possible here.
    """
    from ..leaderboard.service.server import listening

    try:
        return listening(host, port)
    except OSError as error:
        told = {
            errno.EADDRINUSE: f"port {port} is taken; name another by --port, or 0 for a free one",
            errno.EACCES: f"port {port} is not for everybody; name one above 1023 by --port",
            errno.EADDRNOTAVAIL: "this machine has no such address; 127.0.0.1 and 0.0.0.0 are",
        }.get(error.errno or 0, error.strerror)
        raise InputError(f"cannot listen at {host}:{port}: {told}") from error


def _url(listener: socket.socket) -> str:
    host, port = listener.getsockname()[:2]
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


def _leave(number: int, frame: FrameType | None) -> None:
    for each in ENDING:
        signal.signal(each, signal.SIG_IGN)  # One is enough; the workers have some seconds.
    raise KeyboardInterrupt
