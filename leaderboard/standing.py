"""A row in its table."""

from dataclasses import dataclass
from datetime import datetime

from ..benchmark.comparison.standing import Estimate
from .event import OUT, Event
from .row import Row


@dataclass(frozen=True)
class Standing:
    """Where a row stands in its season."""

    group: int
    """Rank group, 1 the best; 0 is out of the ranking: withdrawn or removed."""
    row: Row
    """As it is now: of the last rescore, if there was one."""
    at: datetime
    """When it was put on the board."""
    events: tuple[Event, ...]
    """What has happened to it since, oldest first."""
    submitter: str

    @property
    def ranked(self) -> bool:
        """Whether it is in the ranking."""
        return self.group > 0


@dataclass(frozen=True, kw_only=True)
class HumanTeam:
    """The human-human team on a season's hidden episodes: the line that a board is read against."""

    rmse_mm: Estimate
    sparc: float | None
    human_force_n: float


def out_of_ranking(events: tuple[Event, ...]) -> bool:
    """Return whether, after these events, a row is in no ranking."""
    kinds = [event.kind for event in events if event.kind in (*OUT, "reinstatement")]
    return bool(kinds) and kinds[-1] in OUT
