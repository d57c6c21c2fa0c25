"""The service: one ASGI application for a board."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from importlib.metadata import version
from pathlib import Path
from typing import Final

import anyio.to_thread
from colift.leaderboard.client import API
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.pages.links import STATIC
from colift.leaderboard.practice.season_import import open_with_practice
from colift.leaderboard.queue import Queue, Quota
from colift.leaderboard.service import page_routes as pages
from colift.leaderboard.service import published, submitting
from colift.leaderboard.service.answers import Health
from colift.leaderboard.service.dependencies import Rates, Service, ServiceState
from colift.leaderboard.service.documentation import PLACE, Documentation, Pages
from colift.leaderboard.service.errors import FaultHandler, Problem, answer_errors, log
from colift.leaderboard.service.ranker import Ranker
from colift.leaderboard.service.security import Guard, RateLimit
from colift.leaderboard.service.uploads import remove_orphans
from colift.leaderboard.views.page import NAME
from fastapi import APIRouter, FastAPI
from fastapi.middleware.gzip import GZipMiddleware
from fastapi.staticfiles import StaticFiles

THREADS: Final = 12
"""Number of requests that are handled at the same time: less than the database connections."""

SWEEP_S: Final = 600.0
"""Time between two searches for the remains of killed uploads [s]."""


def create_app(
    folder: Path,
    rates: Rates | None = None,
    *,
    name: str = NAME,
    contact: str = "",
    address: str = "",
    quota: Quota | None = None,
    docs: Documentation | None = None,
    play: bool = False,
) -> FastAPI:
    """Return the service of the board in a folder.

    Parameters
    ----------
    folder
        The board's; see :func:`.open_with_practice`.
    rates
        Rate limits of clients.
    name
        Name of the board on its pages.
    contact
        Contact of the maintainer, shown with the rules.
    address
        Address of the board for clients, if it is known; without it, links in feeds are relative.
    quota
        Limits of a submitter.
    docs
        The documentation that the pages link to.
    play
        Whether the pages link to live lifts, under :data:`.PLAY`.

    Raises
    ------
    InputError
        If the board cannot be opened.
    """
    rates = rates or Rates()
    board = open_with_practice(folder)
    remove_orphans(board)

    async def keep_clean() -> None:
        while True:
            await asyncio.sleep(SWEEP_S)
            try:
                await anyio.to_thread.run_sync(remove_orphans, board)
            except Exception:  # For example, the database is away: the next sweep does it.
                log.exception("the remains of uploads could not be removed")

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        anyio.to_thread.current_default_thread_limiter().total_tokens = THREADS
        sweeper = asyncio.create_task(keep_clean())
        ranker = Ranker(board)
        ranker.start()
        yield
        sweeper.cancel()
        await anyio.to_thread.run_sync(ranker.stop)
        board.close()

    app = FastAPI(
        title="colift board",
        version=version("colift"),
        summary="Standings, submissions and bundles of a leaderboard of cooperative lifting.",
        lifespan=lifespan,
        openapi_url=f"{API}/openapi.json",
        docs_url=None,  # FastAPI's own pages load scripts from elsewhere.
        redoc_url=None,
    )
    app.state.folder = board.folder
    app.state.service = ServiceState(
        board=board,
        queue=Queue(board, quota or Quota()),
        tokens=Tokens(board),
        uploads=RateLimit(rate=rates.submitter),
        name=name,
        contact=contact,
        address=address,
        docs=docs,
        play=play,
    )
    answer_errors(app, pages.missing_page)
    app.add_middleware(GZipMiddleware)
    app.add_middleware(FaultHandler)
    app.add_middleware(Guard, rate=rates.address)
    app.include_router(api_router())
    app.include_router(pages.router)
    app.mount("/static", StaticFiles(packages=[*STATIC]))
    if docs is not None and docs.folder is not None:
        app.mount(PLACE, Pages(directory=docs.folder, html=True))
    app.get("/healthz", responses={429: {"model": Problem}})(health)
    return app


def api_router() -> APIRouter:
    """Return the routes of the JSON interface, under ``/api/v1``."""
    router = APIRouter(
        prefix=API,
        responses={
            422: {"model": Problem, "description": "A value is not allowed."},
            429: {"model": Problem, "description": "Too many requests; see Retry-After."},
        },
    )
    router.include_router(published.router)
    router.include_router(submitting.router)
    return router


def health(service: Service) -> Health:
    """Confirm that the service and its database answer."""
    current = [season.name for season in service.board.seasons() if season.current]
    return Health(season=current[0])
