"""The routes of live lifts: the page, its sessions, and replays."""

import asyncio
import json
import re
from typing import Annotated, Final

from colift.benchmark.real_lifts.session_folder import LIFTS
from colift.benchmark.rendering.page import render
from colift.leaderboard.service.errors import problem
from colift.leaderboard.service.security import client_of, seconds
from colift.play.web import limits
from colift.play.web.play import play_of
from fastapi import APIRouter, Path, Request, Response
from fastapi.responses import HTMLResponse

ISOLATED: Final = {"Cross-Origin-Embedder-Policy": "require-corp"}
"""Isolates the page, together with the other headers: its clock is exact to 5 us, not to 100."""

LIFT: Final = re.compile(r"[0-9]{3,6}")
"""Number of a lift, as in the name of its folder."""

router: Final = APIRouter()


@router.get("/", response_class=HTMLResponse)
def page(request: Request) -> HTMLResponse:
    """Show the page on which people lift."""
    play = play_of(request)
    root = str(request.scope.get("root_path", "")).rstrip("/")
    descriptions = play.config.descriptions
    text = render(
        __package__,
        "play.html",
        root=root,
        static=f"{root}/static",
        live_static=f"{root}/live-static",
        partners=[(name, descriptions.get(name, "")) for name in play.config.policies],
        home=f"{root.removesuffix(play.path)}/" if play.path else "",
        name=play.config.name,
    )
    return HTMLResponse(text, headers=ISOLATED)


@router.get("/api/health")
async def play_health(request: Request) -> dict[str, str | int]:
    """Confirm that the web process answers, with the number of rooms."""
    play = play_of(request)
    rooms, waiting = play.keeper.rooms, play.keeper.waiting
    return {"status": "ok", "rooms": rooms, "most": play.config.rooms, "waiting": waiting}


@router.get("/api/geometry")
async def scene(request: Request) -> Response:
    """Send the shapes that the page draws."""
    return Response(play_of(request).geometry, media_type="application/json")


@router.post("/api/sessions")
async def new_session(request: Request) -> dict[str, str]:
    """Create a session, and return the host's secret."""
    play = play_of(request)
    if "origin" in request.headers and not limits.same_origin(request):
        raise problem(403, "a session is made by a page of this server")
    wait = play.new_sessions.wait(client_of(request))
    if wait:
        message = f"too many sessions from your address; try again in {seconds(wait)} s"
        raise problem(429, message, {"Retry-After": seconds(wait)})
    session = await asyncio.to_thread(play.sessions.make)
    return {"session": session.name, "secret": session.secret("host")}


@router.get("/api/sessions/{name}/lifts/{lift}/replay")
async def session_replay(
    request: Request, name: str, lift: Annotated[str, Path(pattern=f"^{LIFT.pattern}$")]
) -> Response:
    """Send the replay of a lift to a holder of a secret of its session."""
    play = play_of(request)
    kind, _, credential = request.headers.get("authorization", "").partition(" ")
    owner, _, secret = credential.partition(".")
    session = await asyncio.to_thread(play.sessions.find, name)
    if session is None or kind != "Bearer" or owner != name or session.role_of(secret) is None:
        headers = {"WWW-Authenticate": "Bearer"}
        raise problem(
            401, "a replay needs a secret of its session, which is in the session's link", headers
        )
    found = await asyncio.to_thread(lambda: sorted((session.folder / LIFTS).glob(f"{lift}-*/")))
    if not found:
        raise problem(404, f"this session has no lift {lift}")
    if play.replays.full:
        raise problem(503, "many replays are being made; try again", {"Retry-After": "5"})
    content = await play.replays.make(found[0])
    return Response(json.dumps(content), media_type="application/json")
