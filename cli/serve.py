"""``colift serve``: a board on the web, and the workers that evaluate its submissions."""

import sys
from asyncio import Protocol
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final
from urllib.parse import urlsplit

import typer
from colift.agents.sandbox.host.levels import check_level
from colift.agents.spec import AUTO
from colift.agents.submissions.folder import MIB
from colift.base.errors import InputError
from colift.base.extras import how_to_install
from colift.benchmark.execution.pool import default_jobs
from colift.cli.board_options import (
    BOARD,
    BoardFolder,
    BoardIsolation,
    Title,
    open_patiently,
    opened_board,
)
from colift.cli.listening import LOOPBACK, Host, Port, listening_at, url_of
from colift.cli.partners import partners
from colift.cli.signals import until_signalled
from colift.leaderboard.logs import write_log
from colift.leaderboard.queue import Quota
from colift.leaderboard.views.page import NAME

if TYPE_CHECKING:
    from fastapi import FastAPI


LIVE: Final = "live"
"""Folder of the sessions of live lifts, inside the board's folder."""


def serve_board(
    board: BoardFolder = BOARD,
    title: Title = NAME,
    host: Host = LOOPBACK,
    port: Port = 8000,
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
        typer.Option(
            metavar="/PATH|URL",
            help="Path of the board behind a reverse proxy, or its whole address, https://...",
        ),
    ] = "",
    rooms: Annotated[
        int,
        typer.Option(
            "--play",
            metavar="N",
            min=0,
            max=64,
            help="Rooms in which visitors lift with policies, under /play/; 0: none.",
        ),
    ] = 0,
) -> None:
    """Serve a board on the web: its pages, its JSON interface, and uploads.

    Example: colift serve --board board
    """
    try:
        from colift.leaderboard.service.app import create_app
        from colift.leaderboard.service.documentation import Documentation
        from colift.leaderboard.service.server import make_server, running

        if rooms:
            import websockets  # noqa: F401
    except ModuleNotFoundError as error:
        raise InputError(
            f"{error.name} is not installed; a board on the web needs: {how_to_install('board')}"
        ) from error
    address = root.rstrip("/") if "://" in root else ""
    documentation = Documentation.at(docs) if docs else None
    quota = Quota(rows=rows_a_day, size=kept * MIB)
    if isolation != AUTO:
        check_level(isolation)  # Otherwise each worker would fail again and again.
    write_log()
    command = [sys.executable, "-m", "colift.cli", "worker", "--board", str(board.absolute())]
    command += ["--jobs", str(max(1, default_jobs() // max(1, workers)))]  # They share the cores.
    command += ["--isolation", isolation]
    with until_signalled():  # uvicorn raises the signals again after closing.
        with opened_board(board, open_patiently, new=True):
            pass  # Its database server may start at the same time.
        with listening_at(host, port) as listener:
            app = create_app(
                board,
                name=title,
                contact=contact,
                address=address,
                quota=quota,
                docs=documentation,
                play=rooms > 0,
            )
            sockets = _offer_rooms(app, board, title, rooms) if rooms else None
            path = urlsplit(address).path if address else root.rstrip("/")
            server = make_server(app, path, sockets)
            with running(command, workers):
                print(f"Board {board}: {url_of(listener)} (Ctrl-C ends it)", flush=True)
                server.run(sockets=[listener])


def _offer_rooms(app: "FastAPI", board: Path, title: str, rooms: int) -> "type[Protocol]":
    """Let visitors of a board lift with all policies; return the protocol of their sockets."""
    from colift.leaderboard.service.dependencies import PLAY
    from colift.play.web.app import create_play, mount_play
    from colift.play.web.keeper import PlayConfig
    from colift.play.web.processes import SmallBuffers

    named, lines = partners()
    config = PlayConfig(
        folder=(board / LIVE).absolute(),
        policies=named,
        name=title,
        descriptions=lines,
        rooms=rooms,
        strict=True,
    )
    mount_play(app, create_play(config, path=PLAY), PLAY)
    return SmallBuffers
