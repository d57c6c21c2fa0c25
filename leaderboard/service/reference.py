"""The description of the API as a page, made from its OpenAPI document, without other scripts."""

from typing import Final

from colift.leaderboard.pages.rendering import render_page
from colift.leaderboard.service.dependencies import Service, links_of
from colift.leaderboard.service.openapi import operations, schemas
from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse

router: Final = APIRouter(include_in_schema=False)


@router.get("/api")
def api_page(service: Service, request: Request) -> HTMLResponse:
    """Return the page."""
    document = request.app.openapi()
    links = links_of(request)
    current = next(season for season in service.board.seasons() if season.current)
    return HTMLResponse(
        render_page(
            "api.html",
            links,
            season=current,
            root=links.root,
            url=request.app.openapi_url,
            info=document["info"],
            operations=list(operations(document)),
            schemas=list(schemas(document)),
        )
    )
