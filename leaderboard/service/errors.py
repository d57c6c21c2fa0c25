"""Error responses: one line that says how to correct the request, without a traceback."""

import asyncio
import contextlib
import logging
import secrets
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

from colift.base.errors import InputError
from colift.leaderboard.database.connection import AWAY
from colift.leaderboard.database.room import is_full
from colift.leaderboard.queue import QuotaError
from colift.leaderboard.storage.damage import DamagedError
from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import HTMLResponse, JSONResponse, Response
from pydantic import BaseModel, Field
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

log: Final = logging.getLogger("colift.service")

REQUEST_ID: Final = "X-Request-ID"
"""Header of every answer, by which the log names a failed request."""

CLOSE: Final = {"Connection": "close"}
"""Header of an answer to a request whose rest is not read."""

LINGER_S: Final = 10.0
"""Longest time for which the rest is discarded [s]."""

QUOTA_S: Final = 60
"""Time after which a submitter over quota may ask again [s]."""

AWAY_S: Final = 10
"""Time after which a client may ask again if the database is away [s]."""

PAGE: Final = (
    '<!doctype html><html lang="en"><title>The board does not answer</title>'
    "<h1>The board does not answer</h1><p>{message}.</p></html>"
)
"""The page that is shown then: nothing on it needs the database."""

NO_PAGE: Final = "This board has no page at this address."
"""What the page says that a browser gets for a wrong address."""


class Problem(BaseModel):
    """The answer to a request that could not be fulfilled."""

    error: str = Field(description="What was wrong, and what would be right.")


def problem(status: int, error: str, headers: Mapping[str, str] | None = None) -> HTTPException:
    """Return the exception that a route raises to answer with an error."""
    return HTTPException(status, error, headers)


def answer_errors(app: FastAPI, missing: Callable[[Request, str], Response] | None = None) -> None:
    """Answer every error of an application with a :class:`Problem`.

    Parameters
    ----------
    app
        The application.
    missing
        Returns the page for an address of no page, from the request and a message: a browser gets
        it instead.
    """

    @app.exception_handler(HTTPException)
    async def refused(request: Request, error: HTTPException) -> Response:
        message = error.detail
        if missing is not None and error.status_code == 404 and _wants_page(request):
            return await run_in_threadpool(missing, request, NO_PAGE)
        if message == "Not Found":
            message = f"there is no {_shown(request.url.path)} here; the API is described at /api"
        elif message == "Method Not Allowed":
            allowed = (error.headers or {}).get("Allow", "GET")
            message = f"{request.method} is not possible here; {allowed} is"
        kind = LastAnswer if CLOSE.items() <= (error.headers or {}).items() else JSONResponse
        return kind({"error": message}, error.status_code, error.headers)

    @app.exception_handler(RequestValidationError)
    async def invalid(request: Request, error: RequestValidationError) -> Response:
        if missing is not None and _wants_page(request):
            return await run_in_threadpool(missing, request, NO_PAGE)
        return JSONResponse({"error": _first(error.errors())}, 422)

    @app.exception_handler(InputError)
    async def wrong(request: Request, error: InputError) -> JSONResponse:
        # Messages of the library may name paths of this machine, which are not published.
        message = str(error).replace(str(request.app.state.folder), "the board")
        if isinstance(error, QuotaError):
            return JSONResponse({"error": message}, 429, {"Retry-After": str(QUOTA_S)})
        return JSONResponse({"error": message}, 422)


class LastAnswer(JSONResponse):
    """An answer before the request was read: it is sent at once, then the connection ends.

    The rest of the request is discarded for a while: a client that is still sending does not
    listen, and would lose the answer if the connection was cut.
    """

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send the answer."""
        headers = self.raw_headers
        await send({"type": "http.response.start", "status": self.status_code, "headers": headers})
        await send({"type": "http.response.body", "body": self.body, "more_body": True})
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(LINGER_S):
                while (await receive()).get("more_body"):
                    pass
        await send({"type": "http.response.body", "body": b""})


class FaultHandler:
    """ASGI middleware that gives every request an id, logs unexpected errors and answers 500."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        name = secrets.token_hex(8)
        started = False

        async def named(message: Message) -> None:
            nonlocal started
            if message["type"] == "http.response.start":
                started = True
                message["headers"] = [
                    *message["headers"],
                    (REQUEST_ID.lower().encode(), name.encode()),
                ]
            await send(message)

        try:
            await self.app(scope, receive, named)
        except Exception as error:
            known = _known(error)
            log.error(
                "request %s: %s %s failed%s",
                name,
                scope["method"],
                ascii(scope["path"]),
                f": {known}" if known else "",
                exc_info=not known,
            )
            if started:
                raise  # The answer has begun, so it can only be broken off.
            status, message = _fault(error, name)
            headers = {"Retry-After": str(AWAY_S)} if status == 503 else {}
            answer: Response = JSONResponse({"error": message}, status, headers)
            if _is_of_page(scope["path"]):
                answer = HTMLResponse(PAGE.format(message=message), status, headers)
            await answer(scope, receive, named)


def _wants_page(request: Request) -> bool:
    """Return whether a request is a browser's for a page."""
    root = str(request.scope.get("root_path", ""))
    mounted = root != request.scope.get("app_root_path", root)  # Files, and the documentation.
    page = _is_of_page(request.url.path.removeprefix(root))
    reads = request.method in ("GET", "HEAD")
    return page and not mounted and reads and "text/html" in request.headers.get("Accept", "")


def _is_of_page(path: str) -> bool:
    """Return whether a path, below the board's own, is not of the JSON interface."""
    return not path.startswith(("/api/", "/healthz"))


def _known(error: Exception) -> str:
    """Return the cause of an error in a sentence, if it is one that needs no traceback."""
    if is_full(error):
        return f"the disk of the board is full: {' '.join(str(error).split())}"
    if isinstance(error, DamagedError):
        return str(error)
    return f"the database does not answer: {error}" if isinstance(error, AWAY) else ""


def _fault(error: Exception, name: str) -> tuple[int, str]:
    """Return status and text of the answer to a request that ended with an error."""
    if is_full(error):
        return 507, "the board has no room left; please inform its maintainer"
    if isinstance(error, AWAY):
        return 503, f"the board's database does not answer; try again in {AWAY_S} s"
    return (
        500,
        f"the board has failed; please inform the maintainer that request {name} failed",
    )


def _first(errors: Sequence[Any]) -> str:
    """Return the first of pydantic's errors as a line: place, message and given value."""
    error = errors[0]
    where = " ".join(map(str, error["loc"])) or "request"
    message = f"{where}: {error['msg']}"
    given = error.get("input")
    return f"{message}; got {_shown(given)}" if isinstance(given, str | int | float) else message


def _shown(value: object) -> str:
    text = str(value)
    return ascii(text if len(text) <= 60 else f"{text[:60]}...")
