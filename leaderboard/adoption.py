"""What a board can take over that was evaluated elsewhere: a season with its rows."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ..benchmark.references import Reference
from .entry import Entry
from .season import SeasonInfo


@dataclass(frozen=True, kw_only=True)
class Adopted:
    """An entry from elsewhere."""

    entry: Entry
    hidden_rmse_mm: tuple[float, ...] = field(default=(), repr=False)
    """RMSE of each hidden episode, if it has a row: the ranks follow from it."""
    bundle: Path | None = None
    """Folder of the public run; it is copied."""


@dataclass(frozen=True, kw_only=True)
class Practice:
    """A season whose secret is public, as it can be shipped."""

    info: SeasonInfo
    """With the secret. ``current``: whether submissions go there, too."""
    entries: Sequence[Adopted]
    team: Reference
    """The human-human team on the hidden episodes."""
