"""Uploads: from the bytes of a request to a submission in the board."""

import asyncio
import shutil
import tempfile
import time
from collections.abc import AsyncIterator, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Final

from fastapi import Request
from starlette.concurrency import run_in_threadpool
from starlette.requests import ClientDisconnect

from ...agents.errors import InputError
from ...agents.submissions.folder import MIB
from ...agents.submissions.submission import Submission, read_submission
from ..archive import unpack
from ..board import Board
from .errors import CLOSE, problem

BODY: Final = 64 * MIB
"""Largest body [bytes]. Whoever needs more can write to the board's folder itself."""

ZIP: Final = "application/zip"
TYPES: Final = {ZIP, "application/x-zip-compressed", "application/octet-stream"}
"""What browsers and tools call a zip archive."""

IDLE_S: Final = 30.0
"""How long a client may be silent [s]."""

LONGEST_S: Final = 900.0
"""How long an upload may take [s]."""

PREFIX: Final = ".upload-"
"""How the folder of an upload under way is called, beside the submissions."""


def check_headers(request: Request) -> None:
    """Refuse at once what says itself that it is no upload or too large.

    Raises
    ------
    HTTPException
        415 or 413.
    """
    kind = request.headers.get("Content-Type", "").partition(";")[0].strip().lower()
    if kind not in TYPES:
        told = f"the body must be a zip archive, {ZIP}; this is {kind[:60] or 'of no type'!r}"
        raise problem(415, told, CLOSE)
    length = request.headers.get("Content-Length", "0")
    if not length.isdecimal() or int(length[:20]) > BODY:
        raise _too_large()


async def receive_submission(request: Request, board: Board) -> Submission:
    """Return the submission that a request brings, kept in the board.

    Nothing of a request that fails is left on the disk; what it takes meanwhile is bounded by
    :data:`BODY` and what may come out of an archive.

    Raises
    ------
    HTTPException
        If the body is too large, too slow, or breaks off.
    InputError
        If it is no zip archive, or not of a submission.
    """
    with _workplace(board) as place, (place / "upload.zip").open("w+b") as file:
        await _receive(request.stream(), file)
        return await run_in_threadpool(_keep, file, place / "files", board)


def sweep(board: Board) -> None:
    """Remove what uploads have left that were under way when a service was killed."""
    for path in (board.folder / "submissions").glob(".*"):
        if time.time() - path.stat().st_mtime > 2 * LONGEST_S:
            shutil.rmtree(path, ignore_errors=True)


@contextmanager
def _workplace(board: Board) -> Iterator[Path]:
    # Not in /tmp, which may be memory.
    with tempfile.TemporaryDirectory(dir=board.folder / "submissions", prefix=PREFIX) as place:
        yield Path(place)


async def _receive(stream: AsyncIterator[bytes], file: IO[bytes]) -> None:
    """Write a body into a file; the length that the client has told is not trusted."""
    left = BODY
    try:
        async with asyncio.timeout(LONGEST_S):
            while True:
                async with asyncio.timeout(IDLE_S):
                    data = await anext(stream, None)
                if data is None:
                    return
                left -= len(data)
                if left < 0:
                    raise _too_large()
                file.write(data)
    except TimeoutError:
        told = f"the upload is too slow; it may take {LONGEST_S:.0f} s, and pause for {IDLE_S:.0f}"
        raise problem(408, told, CLOSE) from None
    except ClientDisconnect:
        raise problem(400, "the upload broke off") from None


def _keep(file: IO[bytes], folder: Path, board: Board) -> Submission:
    folder.mkdir()
    try:
        unpack(file, folder)  # type: ignore[arg-type]
        read_submission(folder)
    except InputError as error:
        # The user knows nothing of our folders.
        told = str(error).replace(f"{folder}/", "").replace(str(folder), "the zip archive")
        raise InputError(told) from error
    return board.keep(folder)


def _too_large() -> Exception:
    return problem(413, f"a zip archive may have {BODY // MIB} MiB", CLOSE)
