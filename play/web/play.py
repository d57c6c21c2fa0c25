"""The state that the routes of live lifts share."""

import asyncio
import gc
import json
from collections.abc import Awaitable, Callable

from colift.benchmark.robots.robot import DEFAULT_ROBOT
from colift.leaderboard.replays.geometry import geometry
from colift.leaderboard.service.security import RateLimit
from colift.play.web import limits
from colift.play.web.keeper import Keeper, PlayConfig
from colift.play.web.replaying import Replays
from colift.play.web.sessions import Sessions
from fastapi import Request, WebSocket


class Play:
    """The state that the routes share.

    Parameters
    ----------
    config
        The partners, and the number of rooms.
    path
        Path of a board under which this is mounted; empty if there is none.
    obstacle
        See :class:`.Keeper`.
    """

    def __init__(
        self, config: PlayConfig, path: str, obstacle: Callable[[], Awaitable[str | None]]
    ) -> None:
        self.config, self.path = config, path
        self.sessions = Sessions(config.folder)
        self.keeper = Keeper(config, obstacle)
        self.replays = Replays()
        self.sockets = limits.Places(limits.SOCKETS)
        self.new_sessions = RateLimit(rate=limits.SESSIONS)
        self.geometry = b""

    async def start(self) -> None:
        """Begin to assign rooms."""
        robot = {"robot": self.config.robot} if self.config.robot != DEFAULT_ROBOT else {}
        self.geometry = await asyncio.to_thread(
            lambda: json.dumps({**geometry(), **robot}).encode()
        )
        self.keeper.start()
        gc.collect()
        gc.freeze()

    async def close(self) -> None:
        """End all rooms."""
        await self.keeper.close()
        self.replays.close()


def play_of(connection: Request | WebSocket) -> Play:
    """Return the state that the routes share."""
    found: Play = connection.app.state.play
    return found
