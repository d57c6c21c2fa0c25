"""The service: one ASGI application for a board."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from importlib.metadata import version
from pathlib import Path
from typing import Final

import anyio.to_thread
from fastapi import FastAPI
from fastapi.middleware.gzip import GZipMiddleware
from fastapi.staticfiles import StaticFiles

from ..opening import open_stocked
from ..pages import routes as pages
from ..queue import Queue
from ..tokens import Tokens
from . import api, reference
from .answers import Health
from .asked import PREFIX
from .errors import Faults, Problem, answer_errors
from .security import Guard, RateLimit
from .state import Rates, Service, State
from .uploads import sweep

THREADS: Final = 12
"""Requests that are worked on at the same time: less than there are database connections."""


def create_app(folder: Path, rates: Rates | None = None) -> FastAPI:
    """Return the service of the board in a folder.

    Parameters
    ----------
    folder
        The board's; see :func:`.open_stocked`.
    rates
        How often a client may ask.

    Raises
    ------
    InputError
        If the board cannot be opened.
    """
    rates = rates or Rates()
    board = open_stocked(folder)
    sweep(board)

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        anyio.to_thread.current_default_thread_limiter().total_tokens = THREADS
        yield
        board.close()

    app = FastAPI(
        title="colift board",
        version=version("colift"),
        summary="Standings, submissions and bundles of a leaderboard of cooperative lifting.",
        lifespan=lifespan,
        openapi_url=f"{PREFIX}/openapi.json",
        docs_url=None,  # These pages load scripts from elsewhere.
        redoc_url=None,
    )
    app.state.folder = board.folder
    app.state.service = State(
        board=board,
        queue=Queue(board),
        tokens=Tokens(board),
        uploads=RateLimit(rate=rates.submitter),
    )
    answer_errors(app)
    app.add_middleware(GZipMiddleware)
    app.add_middleware(Faults)
    app.add_middleware(Guard, rate=rates.address)
    app.include_router(api.router)
    app.include_router(reference.router)
    app.include_router(pages.router)
    app.mount("/static", StaticFiles(packages=[("colift.leaderboard.pages", "static")]))
    app.get("/healthz", responses={429: {"model": Problem}})(health)
    return app


def health(service: Service) -> Health:
    """Say that the service answers, and its database."""
    current = [season.name for season in service.board.seasons() if season.current]
    return Health(season=current[0])
