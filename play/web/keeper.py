"""The keeper of the rooms: assignment, waiting sessions, and replacement of rooms that die."""

import asyncio
import logging
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from colift.agents.spec import AgentSpec
from colift.benchmark.real_lifts.session_folder import SessionFolder
from colift.benchmark.robots.robot import DEFAULT_ROBOT
from colift.leaderboard.views.page import NAME
from colift.play.rooms.process import RoomProcess, start_room
from colift.play.rooms.room import RoomConfig
from colift.play.web.group import Group
from colift.play.web.load import busy
from colift.play.web.page import REFUSED, Page
from colift.play.web.relay import RoomLink
from colift.play.web.sessions import LiveSession, Role

log: Final = logging.getLogger("colift.play")

RETRY_S: Final = 1.0
"""Time between two checks of the waiting sessions [s]."""

AWAY_S: Final = 30.0
"""Time for which a room waits for people who have left [s]."""

IDLE_S: Final = 300.0
"""Time for which people may be idle in a room while others wait for one [s]."""

DEATHS, DEATHS_S = 3, 60.0
"""Number of rooms of a session, and time within which their deaths are a lasting fault [s]."""


@dataclass(frozen=True, kw_only=True)
class PlayConfig:
    """The partners of people, and the number of rooms."""

    folder: Path
    """Folder of the sessions, each of which is a folder."""
    policies: Mapping[str, AgentSpec]
    """Partners by the names that pages use, in order; the first is the default."""
    name: str = NAME
    """Name of the board on the page."""
    robot: str = DEFAULT_ROBOT
    """The robot that policies move."""
    descriptions: Mapping[str, str] = field(default_factory=dict)
    """A line about each of them."""
    rooms: int = 8
    """Largest number of rooms at the same time."""
    strict: bool = False
    """Whether even the first room is refused while the machine is busy. Otherwise only its own
    lifts suffer, and they are marked."""
    away_s: float = AWAY_S
    """Time for which a room waits for people who have left [s]."""
    hosts: frozenset[str] = frozenset()
    """Host names by which browsers may request the page; empty: any."""


class Keeper:
    """All rooms of this machine.

    Parameters
    ----------
    config
        The partners, and the number of rooms.
    obstacle
        Returns the reason, as a sentence, why this machine has no time for another room, or None.
    """

    def __init__(
        self, config: PlayConfig, obstacle: Callable[[], Awaitable[str | None]] = busy
    ) -> None:
        self._config = config
        self._busy = obstacle
        self._groups: dict[str, Group] = {}
        self._queue: list[Group] = []
        self._leaving: dict[str, asyncio.TimerHandle] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        self._wanted = asyncio.Event()
        self._closing = False

    @property
    def rooms(self) -> int:
        """The number of rooms."""
        return sum(group.housed for group in self._groups.values())

    @property
    def waiting(self) -> int:
        """The number of sessions that wait for a room."""
        return len(self._queue)

    def start(self) -> None:
        """Begin to assign rooms."""
        self._spawn(self._admit())

    async def close(self) -> None:
        """End all rooms."""
        self._closing = True
        links = [group.link for group in self._groups.values() if group.link is not None]
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        await asyncio.gather(*(link.close() for link in links))

    def enter(self, session: LiveSession, role: Role, page: Page) -> tuple[Group, int] | None:
        """Give a page its seat, and the session a room or a place in the queue.

        Returns
        -------
        tuple of Group and int, or None
            The session's pages, and the seat; None if there are too many spectators.
        """
        now = asyncio.get_running_loop().time()
        group = self._groups.setdefault(session.name, Group(session, now))
        seat = group.free_seat(role)
        if seat is None:
            return None
        if leaving := self._leaving.pop(session.name, None):
            leaving.cancel()
        group.active = now
        group.enter(seat, page)
        if not group.people:
            if not group.housed:
                page.say("queued", place=0, reason="Nobody lifts in this session now.")
            self._forget_later(group)
        elif not group.housed and group not in self._queue:
            self._queue.append(group)
            self._wanted.set()
        return group, seat

    def leave(self, group: Group, seat: int, page: Page) -> None:
        """Free the seat of a page that has gone; a room without people ends after a while."""
        group.leave(seat, page)
        if page.dropped:
            self._note(group, "frames dropped", seat=seat, frames=page.dropped)
        if not group.people:
            self._forget_later(group)

    def _forget_later(self, group: Group) -> None:
        name = group.session.name
        if name not in self._leaving and self._groups.get(name) is group:
            loop = asyncio.get_running_loop()
            self._leaving[name] = loop.call_later(self._config.away_s, self._forgotten, group)

    def _forgotten(self, group: Group) -> None:
        self._leaving.pop(group.session.name, None)
        if group.pages and not group.housed and group not in self._queue:
            self._forget_later(group)  # Spectators who have come first.
        else:
            self._end(group, "Nobody lifts in this session any more.")

    async def _admit(self) -> None:
        """Assign rooms to the waiting sessions, one after the other."""
        while True:
            await self._wanted.wait()
            self._wanted.clear()
            while self._queue:
                reason = await self._obstacle()
                ready = next((group for group in self._queue if group.people), None)
                if reason is None and ready is not None:
                    self._queue.remove(ready)
                    ready.housed = True
                    await self._open(ready)
                    continue
                for place, group in enumerate(self._queue, start=1):
                    group.wait(place, reason)
                await asyncio.sleep(RETRY_S)

    async def _obstacle(self) -> str | None:
        if not self.rooms and not self._config.strict:
            return None
        if self.rooms < self._config.rooms:
            return await self._busy()
        idle = asyncio.get_running_loop().time() - IDLE_S
        for group in list(self._groups.values()):
            if group.housed and group.active < idle:
                minutes = round(IDLE_S / 60)
                self._end(group, f"Nothing was done here for {minutes} minutes, and others wait.")
                return None
        most = self._config.rooms
        return "The only room is taken." if most == 1 else f"All {most} rooms are taken."

    async def _open(self, group: Group) -> None:
        """Start the room of a session."""
        config = RoomConfig(
            folder=group.session.folder,
            policies=self._config.policies,
            robot=self._config.robot,
            cue_seed=group.session.cue_seed,
        )
        try:
            room = await asyncio.to_thread(start_room, config)
        except Exception:  # Others wait: their turn comes.
            log.exception("the room of session %s cannot start", group.session.name)
            self._end(group, "The room cannot start; the server's log has the reason.")
            return
        self._connect(group, room)

    def _connect(self, group: Group, room: RoomProcess) -> None:
        link = RoomLink(room, group.from_room, lambda: self._died(group, link))
        if self._groups.get(group.session.name) is group:
            group.connect(link)
        else:  # All left while it started.
            self._spawn(link.close())

    def _died(self, group: Group, link: RoomLink) -> None:
        """Replace a room that has ended by itself; the people in it stay."""
        self._spawn(link.close())
        if group.link is not link or self._closing:
            return
        group.lose()
        now = asyncio.get_running_loop().time()
        group.deaths = [each for each in group.deaths if now - each < DEATHS_S] + [now]
        log.error("the room of session %s has ended by itself", group.session.name)
        self._note(group, "room lost")
        if len(group.deaths) >= DEATHS:
            self._end(group, "The room has failed repeatedly; the server's log has the reason.")
            return
        group.say("room_lost", message="The room has failed; this lift does not count.")
        self._spawn(self._open(group))

    def _end(self, group: Group, message: str) -> None:
        """End a session's room, if it has one, and send its pages the reason."""
        name = group.session.name
        if self._groups.get(name) is group:
            del self._groups[name]
        if group in self._queue:
            self._queue.remove(group)
        if leaving := self._leaving.pop(name, None):
            leaving.cancel()
        link = group.link
        group.lose()
        group.housed = False
        self._wanted.set()
        if link is not None:
            self._spawn(link.close())
        for page in group.pages.values():
            page.end(REFUSED, "refused", message)

    def _note(self, group: Group, kind: str, **content: Any) -> None:
        def write() -> None:
            SessionFolder(group.session.folder).event(kind, **content)

        self._spawn(asyncio.to_thread(write))

    def _spawn(self, work: Awaitable[None]) -> None:
        async def run() -> None:
            try:
                await work
            except Exception:
                log.exception("an error in the keeper of rooms")

        task = asyncio.create_task(run())
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
