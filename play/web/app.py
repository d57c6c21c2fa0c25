"""The application of live lifts, on its own or on a board."""

from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from typing import Any, Final

from colift.leaderboard.service.errors import FaultHandler, answer_errors
from colift.leaderboard.service.security import Guard, Rate
from colift.play.web import joining, limits, routes
from colift.play.web.keeper import PlayConfig
from colift.play.web.load import busy
from colift.play.web.play import Play
from fastapi import FastAPI
from fastapi.middleware.gzip import GZipMiddleware
from fastapi.staticfiles import StaticFiles

REQUESTS: Final = Rate(per_second=50.0, burst=500)
"""Of requests from an address."""


def create_play(
    config: PlayConfig,
    *,
    path: str = "",
    obstacle: Callable[[], Awaitable[str | None]] = busy,
) -> FastAPI:
    """Return the application of live lifts.

    Parameters
    ----------
    config
        The partners, and the number of rooms.
    path
        Path of a board under which it is mounted, such as ``/play``: the board then sets headers
        and limits requests. Empty if it is on its own.
    obstacle
        See :class:`.Keeper`.
    """
    play = Play(config, path, obstacle)

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        await play.start()
        try:
            yield
        finally:
            await play.close()

    app = FastAPI(
        title="colift play", lifespan=lifespan, openapi_url=None, docs_url=None, redoc_url=None
    )
    app.state.play = play
    app.state.folder = config.folder
    answer_errors(app)
    app.add_middleware(GZipMiddleware)
    if not path:
        app.add_middleware(limits.KnownHosts, names=config.hosts)
        app.add_middleware(FaultHandler)
        app.add_middleware(Guard, rate=REQUESTS)
    app.include_router(routes.router)
    app.include_router(joining.router)
    app.mount("/static", StaticFiles(packages=[("colift.leaderboard", "static")]))
    app.mount("/live-static", StaticFiles(packages=[("colift.play.web", "static")]))
    return app


def mount_play(board: FastAPI, play: FastAPI, path: str) -> None:
    """Serve live lifts under a path of a board, while the board runs."""
    board.mount(path, play)
    outer = board.router.lifespan_context

    @asynccontextmanager
    async def both(app: Any) -> AsyncIterator[Any]:
        async with outer(app) as state, play.router.lifespan_context(play):
            yield state

    board.router.lifespan_context = both
