"""What has happened on a board: who did it, when and why."""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Literal

Kind = Literal["season", "revelation", "withdrawal", "removal", "reinstatement", "rescore", "retry"]
"""A season began or its secret was published; a submission was withdrawn by who made it, removed
by who keeps the board, taken back into the ranking, scored anew, or queued again."""

OUT: tuple[Kind, ...] = ("withdrawal", "removal")
"""After these a row is in no ranking, until a reinstatement."""


@dataclass(frozen=True, kw_only=True)
class Event:
    """Something that was done to a season, or to a submission in it."""

    at: datetime
    who: str
    kind: Kind
    why: str
    season: str
    submission: str | None
    content: Mapping[str, Any] | None
    """What belongs to it: a revealed ``secret``, a new ``row``."""

    def plain(self) -> dict[str, Any]:
        """Return the event as JSON has it."""
        return {**vars(self), "at": self.at.isoformat()}
