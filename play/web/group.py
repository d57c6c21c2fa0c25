"""The pages of one session: people in their seats, spectators, and the messages to each."""

import json
from typing import Any, Final

from colift.play.rooms.process import BINARY, JOIN, LEAVE, packet
from colift.play.rooms.seats import ALL, watched_sentence
from colift.play.web.page import TAKEN_OVER, Message, Page
from colift.play.web.relay import RoomLink
from colift.play.web.sessions import LiveSession, Role

SEATS: Final[dict[Role, int]] = {"host": 0, "person": 1}
"""Seats of the people who lift."""

WATCHING: Final = range(2, 22)
"""Seats of spectators in the room, which answers their pings there."""

FROM_PEOPLE: Final = {"ping", "choose", "grip", "release", "hidden", "report", "swap"}
FROM_SPECTATORS: Final = {"ping"}
"""Types of messages that are passed on to the room."""

WATCHED: Final = {"start", "end", "void", "state"}
"""Types of messages to the host that spectators also get."""

KEPT: Final = {"state", "start"}
"""Types of messages of which a spectator who comes later gets the last one."""


class Group:
    """A session's pages, and the room that they share while there is one.

    Parameters
    ----------
    session
        The session.
    now
        Time of the event loop [s].
    """

    def __init__(self, session: LiveSession, now: float) -> None:
        self.session = session
        self.pages: dict[int, Page] = {}
        self.link: RoomLink | None = None
        """The room; None while it is being started, too."""
        self.housed = False
        """Whether it has a room, or one is being started for it."""
        self.active = now
        """Time of the last action of a person [s]."""
        self.deaths: list[float] = []
        """Times at which rooms of this session died [s]."""
        self._shown: dict[str, str] = {}
        self._chosen: bytes | None = None
        self._waiting: tuple[int, str | None] | None = None

    @property
    def people(self) -> list[int]:
        """Return the seats taken by people."""
        return [seat for seat in SEATS.values() if seat in self.pages]

    def free_seat(self, role: Role) -> int | None:
        """Return the seat for a role; None if there are too many spectators."""
        if role in SEATS:
            return SEATS[role]
        return next((seat for seat in WATCHING if seat not in self.pages), None)

    def enter(self, seat: int, page: Page) -> None:
        """Give a page a seat; end the page that has it with a message."""
        older = self.pages.pop(seat, None)
        if older is not None:
            older.end(TAKEN_OVER, "taken_over", "This place was opened in another window.")
            self._tell_room(seat, LEAVE)
        self.pages[seat] = page
        self._waiting = None
        if self.link is not None:
            self._begin(seat)

    def leave(self, seat: int, page: Page) -> None:
        """Free the seat of a page that has gone, unless another page has taken it."""
        if self.pages.get(seat) is page:
            del self.pages[seat]
            self._tell_room(seat, LEAVE)

    def connect(self, link: RoomLink) -> None:
        """Join a room with all present pages."""
        self.link = link
        for seat in self.pages:
            self._begin(seat)
        if self._chosen is not None and SEATS["host"] in self.pages:
            link.send(self._chosen)

    def lose(self) -> None:
        """Forget a room that has ended."""
        self.link = None
        self._shown.clear()

    def wait(self, place: int, reason: str | None) -> None:
        """Send the pages the reason for waiting and their place in the queue, if these changed."""
        if self._waiting != (place, reason):
            self._waiting = (place, reason)
            self.say("queued", place=place, reason=reason)

    def say(self, kind: str, **content: Any) -> None:
        """Send every page a control message."""
        for page in self.pages.values():
            page.say(kind, **content)

    def from_page(self, seat: int, message: Message, now: float) -> None:
        """Pass a page's message on to the room, if a page may send it."""
        if isinstance(message, bytes):
            if seat in SEATS.values():
                self._to_room(packet(seat, message))
            else:
                self._fault(seat, "a spectator watches; samples are for people who lift")
            return
        allowed = FROM_PEOPLE if seat in SEATS.values() else FROM_SPECTATORS
        kind = _type_of(message)
        if kind not in allowed:
            self._fault(seat, f"type must be one of {', '.join(sorted(allowed))}, got {kind!r:.40}")
            return
        content = packet(seat, message)
        if kind == "choose" and seat == SEATS["host"]:
            self._chosen = content
        if kind != "ping":
            self.active = now
        self._to_room(content)

    def from_room(self, seat: int, kind: bytes, content: bytes) -> None:
        """Pass a packet of the room on to the pages that it is for."""
        message: Message = content if kind == BINARY else content.decode()
        if seat != ALL and seat in self.pages:
            self.pages[seat].send(message)
        if seat not in (SEATS["host"], ALL):
            return
        told = message if isinstance(message, bytes) else self._watched(message)
        for each, page in self.pages.items():
            if each in WATCHING:
                if told is not None:
                    page.send(told)
            elif seat == ALL:
                page.send(message)

    def _begin(self, seat: int) -> None:
        """Tell a page that its room is open, and the room that there is a person."""
        role = next((role for role, its in SEATS.items() if its == seat), "spectator")
        name, host = self.session.name, role == "host"
        self.pages[seat].say(
            "joined",
            session=name,
            seat="spectator" if role == "spectator" else seat,
            invite=f"{name}.{self.session.secret('person')}" if host else None,
            watch=f"{name}.{self.session.secret('spectator')}" if host else None,
        )
        if role == "spectator":
            for message in self._shown.values():
                self.pages[seat].send(message)
        else:
            self._tell_room(seat, JOIN)

    def _tell_room(self, seat: int, kind: bytes) -> None:
        if seat in SEATS.values():
            self._to_room(bytes((seat,)) + kind)

    def _to_room(self, content: bytes) -> None:
        if self.link is not None:
            self.link.send(content)

    def _fault(self, seat: int, message: str) -> None:
        self.pages[seat].say("fault", message=message)

    def _watched(self, message: str) -> str | None:
        """Return the form of a control message to the host that spectators get, if any."""
        kind = _type_of(message)
        if kind not in WATCHED:
            return None
        if kind == "state":
            message = json.dumps(_watched_state(json.loads(message)))
        if kind in KEPT:
            self._shown[kind] = message
        else:
            self._shown.pop("start", None)  # The lift has ended.
        return message


def _watched_state(state: dict[str, Any]) -> dict[str, Any]:
    """Return the host's state of the room as that of somebody who can only watch."""
    told = watched_sentence(state["phase"], state["partner"])
    return {**state, "you": "spectator", "role": None, "message": told}


def _type_of(message: str) -> str | None:
    """Return the type of a control message; None if it is none."""
    try:
        content = json.loads(message)
    except (ValueError, RecursionError):
        return None
    kind = content.get("type") if isinstance(content, dict) else None
    return kind if isinstance(kind, str) else None
