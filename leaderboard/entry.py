"""What a board says of a submission, for good."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

from .row import Row


@dataclass(frozen=True, kw_only=True)
class Entry:
    """An evaluated submission: its row, or why it has none."""

    submission: str
    """Digest of its content."""
    row: Row | None
    refusal: str | None

    def plain(self) -> dict[str, Any]:
        """Return the entry as JSON has it."""
        row = None if self.row is None else self.row.plain()
        return {"submission": self.submission, "row": row, "refusal": self.refusal}

    @classmethod
    def read(cls, content: Mapping[str, Any]) -> Self:
        """Return the entry that :meth:`plain` has written."""
        row = None if content["row"] is None else Row.read(content["row"])
        return cls(submission=content["submission"], row=row, refusal=content["refusal"])
