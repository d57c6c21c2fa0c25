"""Uploads, and removal of those that were interrupted."""

import asyncio
import re
import shutil
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from datetime import timedelta
from pathlib import Path
from typing import IO, Final

import sqlalchemy as sa
from colift.agents.submissions.folder import MIB
from colift.agents.submissions.manifest import MANIFEST
from colift.agents.submissions.near_manifest import PACK, no_manifest
from colift.base.errors import InputError
from colift.leaderboard.core.board import Board
from colift.leaderboard.database.schema import jobs
from colift.leaderboard.service.dependencies import ServiceState
from colift.leaderboard.service.errors import CLOSE, problem
from colift.leaderboard.storage.archive import unpack_archive
from colift.leaderboard.storage.staging import Incoming, remove_abandoned
from fastapi import Request
from starlette.concurrency import run_in_threadpool
from starlette.requests import ClientDisconnect

BODY: Final = 64 * MIB
"""Largest body [bytes]. For more, submit to the board's folder."""

ZIP: Final = "application/zip"
TYPES: Final = {ZIP, "application/x-zip-compressed", "application/octet-stream"}
"""Media types that browsers and tools use for a zip archive."""

LEAST_RATE: Final = 16 * 1024
"""Least rate at which a client must send [bytes/s], over :data:`WINDOW_S`."""

WINDOW_S: Final = 15.0
"""Longest silence of a client [s]; this is also the largest lead that it can gain."""

LONGEST_S: Final = 900.0
"""Longest duration of an upload [s]."""


def check_headers(request: Request) -> None:
    """Refuse at once an upload whose headers name another type or too large a size.

    Raises
    ------
    HTTPException
        415 or 413.
    """
    kind = request.headers.get("Content-Type", "").partition(";")[0].strip().lower()
    if kind not in TYPES:
        message = f"the body must be a zip archive, {ZIP}; this is {kind[:60] or 'of no type'!r}"
        raise problem(415, message, CLOSE)
    length = request.headers.get("Content-Length", "0")
    if not length.isdecimal() or int(length[:20]) > BODY:
        raise _too_large()


@asynccontextmanager
async def received(request: Request, service: ServiceState) -> AsyncIterator[Incoming]:
    """Yield the submission in a request, ready to be placed in the board.

    A submission that is not placed is removed from the disk at the end; until then its size is
    bounded by :data:`BODY` and the limits of an archive's content.

    Raises
    ------
    HTTPException
        If the body is too large, too slow, or breaks off.
    InputError
        If it is not a zip archive, or not one of a submission.
    """
    # Not in /tmp, which may be memory.
    with service.board.store.staging() as place, (place / "upload.zip").open("w+b") as file:
        await _receive(request.stream(), file)
        async with service.unpacking:
            yield await run_in_threadpool(_incoming, file, place / "files", service.board)


async def _receive(stream: AsyncIterator[bytes], file: IO[bytes]) -> None:
    """Write a body into a file; the client's declared length is not trusted."""
    left, clock = BODY, asyncio.get_running_loop().time
    ends, patience = clock() + LONGEST_S, WINDOW_S
    try:
        while True:
            began = clock()
            async with asyncio.timeout_at(min(began + patience, ends)):
                data = await anext(stream, None)
            if data is None:
                return
            left -= len(data)
            if left < 0:
                raise _too_large()
            file.write(data)
            patience = min(patience - (clock() - began) + len(data) / LEAST_RATE, WINDOW_S)
    except TimeoutError:
        message = (
            f"the upload is too slow: it must bring {LEAST_RATE} bytes a second, over any "
            f"{WINDOW_S:g} s, and end within {LONGEST_S:g} s"
        )
        raise problem(408, message, CLOSE) from None
    except ClientDisconnect:
        raise problem(400, "the upload broke off") from None


def _incoming(file: IO[bytes], folder: Path, board: Board) -> Incoming:
    folder.mkdir()
    try:
        packed = unpack_archive(file, folder)  # type: ignore[arg-type]
        if not (folder / MANIFEST).is_file():
            raise no_manifest(packed, "the zip archive", PACK)
        return board.store.incoming(folder)
    except InputError as error:
        # Messages to clients must not name folders of this machine.
        message = str(error).replace(f"{folder}/", "").replace(str(folder), "the zip archive")
        raise InputError(message) from error


def _too_large() -> Exception:
    return problem(413, f"a zip archive may have at most {BODY // MIB} MiB", CLOSE)


AGE: Final = timedelta(hours=1)
"""Age below which a submission may be about to get its job."""

_DIGEST: Final = re.compile("[0-9a-f]{64}")


def remove_orphans(board: Board, age: timedelta = AGE) -> None:
    """Remove the remains of killed uploads; submissions under way are not touched.

    A submission is placed in the transaction that makes its job (see :class:`.Queue`), so during
    another transaction a submission without a job cannot get one.
    """
    folder = board.folder / "submissions"
    remove_abandoned(folder)
    oldest = time.time() - age.total_seconds()
    with board.store.staging() as place:
        with board.database.writing() as connection:
            known = set(connection.scalars(sa.select(jobs.c.submission)))
            for path in folder.iterdir():
                orphan = _DIGEST.fullmatch(path.name) and path.name not in known
                if orphan and path.stat().st_mtime < oldest:
                    path.rename(place / path.name)
        shutil.rmtree(place)  # Not while all others wait.
