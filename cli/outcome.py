"""What has come of a submission."""

from dataclasses import dataclass

from ..leaderboard.row import Row


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """A row, or why there is none."""

    row: Row | None = None
    ranking: tuple[tuple[int, Row], ...] = ()
    """Rank group and row of all that are ranked in its season."""
    reason: str = ""
    """Why there is no row."""
    mend: bool = False
    """Whether that is for the submitter to mend."""
    next: str = ""
    """What to look at."""
