"""What a board says of a submission, for good."""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Self

from .row import Row


@dataclass(frozen=True, kw_only=True)
class Entry:
    """An evaluated submission: its row, or why it has none."""

    season: str
    submission: str
    """Digest of its content."""
    name: str
    """What its policy is called."""
    submitter: str
    """Who put it on the board: the name of a token, or ``local``."""
    at: datetime
    row: Row | None
    refusal: str | None

    def plain(self) -> dict[str, Any]:
        """Return the entry as JSON has it."""
        return {
            "season": self.season,
            "submission": self.submission,
            "name": self.name,
            "submitter": self.submitter,
            "at": self.at.isoformat(),
            "row": None if self.row is None else self.row.plain(),
            "refusal": self.refusal,
        }

    @classmethod
    def read(cls, content: Mapping[str, Any]) -> Self:
        """Return the entry that :meth:`plain` has written."""
        row = None if content["row"] is None else Row.read(content["row"])
        at = datetime.fromisoformat(content["at"])
        return cls(**{**content, "row": row, "at": at})
