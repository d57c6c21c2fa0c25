"""The socket of a page: its admission, and the way to a seat."""

import asyncio
import json
from typing import Final

from colift.leaderboard.service.security import client_of
from colift.play.web import limits
from colift.play.web.group import SEATS
from colift.play.web.page import REFUSED, Page
from colift.play.web.play import Play, play_of
from colift.play.web.sessions import ROLES, LiveSession, Role
from fastapi import APIRouter, WebSocket

ASKED: Final[dict[str, Role]] = {str(SEATS.get(role, role)): role for role in ROLES}
"""Roles by the seats that pages request: a number, or ``spectator``."""

NOT_HERE: Final = "There is no such session, or this link is not for it."

router: Final = APIRouter()


@router.websocket("/socket")
async def socket(websocket: WebSocket) -> None:
    """Connect a page with the room of its session."""
    play = play_of(websocket)
    if not limits.same_origin(websocket):
        await websocket.close()  # Before it was accepted: 403.
        return
    with play.sockets.held(client_of(websocket)) as free:
        await websocket.accept()
        page = Page(websocket)
        if not free:
            await _refuse(page, f"Your address has {limits.SOCKETS} pages open; close one of them.")
            return
        try:
            async with asyncio.timeout(limits.JOIN_S):
                asked = await websocket.receive()
        except TimeoutError:
            asked = {"type": "websocket.receive"}
        if asked["type"] != "websocket.receive":
            return
        session, role = await _admitted(play, asked.get("text"))
        if session is None or role is None:
            await _refuse(page, NOT_HERE)
        else:
            await _seated(play, page, session, role)


async def _admitted(play: Play, text: str | None) -> tuple[LiveSession | None, Role | None]:
    """Return the session in a first message, and the role that its secret allows."""
    try:
        asked = json.loads(text or "")
        name, secret, seat = (str(asked[each]) for each in ("session", "secret", "seat"))
        wanted = ASKED[seat]
        joining = asked["type"] == "join"
    except (ValueError, RecursionError, KeyError, TypeError):
        return None, None
    session = await asyncio.to_thread(play.sessions.find, name)
    if session is None or not joining:
        return None, None
    role = session.role_of(secret)
    return session, role if role == wanted else None


async def _seated(play: Play, page: Page, session: LiveSession, role: Role) -> None:
    """Serve a page in its seat until it has gone."""
    loop = asyncio.get_running_loop()
    entered = play.keeper.enter(session, role, page)
    if entered is None:
        await _refuse(page, "There are too many spectators.")
        return
    group, seat = entered
    try:
        await page.serve(lambda message: group.from_page(seat, message, loop.time()))
    finally:
        play.keeper.leave(group, seat, page)


async def _refuse(page: Page, message: str) -> None:
    """Send the reason why a page gets no seat, and close its socket."""
    page.end(REFUSED, "refused", message)
    await page.serve(lambda message: None)
