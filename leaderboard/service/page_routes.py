"""The pages of the service, from their table; they need no login."""

from collections.abc import Callable
from functools import partial
from typing import Final

from colift.leaderboard.pages.rendering import render_page, show
from colift.leaderboard.pages.table import PAGES
from colift.leaderboard.service.dependencies import links_of, origin_of, service_state
from colift.leaderboard.service.published import rules_of
from colift.leaderboard.views.asked import Asked
from colift.leaderboard.views.page import NoPageError, Page, Visit, find_season
from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse, Response
from starlette.exceptions import HTTPException


def _visit(request: Request) -> Visit:
    """Return what a page is made for; of a name that comes twice in a query, the last value."""
    service, query = service_state(request), request.query_params
    names = ("q", "sort", "behaviour", "columns", "first")
    chosen = query.getlist("p")
    return Visit(
        board=service.board,
        name=service.name,
        asked=Asked.read(p=chosen, **{name: query.get(name, "") for name in names}),
        chosen=chosen,
        origin=origin_of(request),
        queue=service.queue,
        address=service.address,
        rules=partial(rules_of, service),
        document=request.app.openapi,
    )


def _answer(page: Page) -> Callable[[Request], Response]:
    """Return the route of a page."""

    def answer(request: Request) -> Response:
        values = request.path_params
        if not page.fits(values):
            raise HTTPException(404)
        try:
            content = show(page, links_of(request), _visit(request), values)
        except NoPageError as error:
            return missing_page(request, str(error))
        headers = {name: text.format(**values) for name, text in page.headers.items()}
        return Response(content, media_type=page.media, headers=headers)

    return answer


router: Final = APIRouter(include_in_schema=False)
for each in PAGES.values():
    if each.served:
        router.add_api_route(each.url, _answer(each), methods=["GET"], name=each.name)


def missing_page(request: Request, message: str) -> HTMLResponse:
    """Return the page for an address of nothing."""
    service = service_state(request)
    season = find_season(service.board)
    content = {"season": season, "board_name": service.name, "message": message}
    page = render_page("missing.html", links_of(request), **content)
    return HTMLResponse(page, 404)
