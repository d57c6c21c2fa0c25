"""One claim of the paper, and what we measured."""

from collections.abc import Mapping
from dataclasses import dataclass, field

OUTSIDE = "The measured value lies outside the criterion."


@dataclass(frozen=True, kw_only=True)
class Claim:
    """A statement of the paper with a measured answer."""

    claim: str
    """The statement, in words."""
    figure: str
    """Where to look: the report's figure or table."""
    paper: str
    """What the paper reports."""
    criterion: str
    """When we say that it holds."""
    measured: str
    """What we found, in words and numbers."""
    values: Mapping[str, float | None] = field(default_factory=dict)
    """The numbers of ``measured``, units in the names."""
    holds: bool
    note: str = ""
    """What the data say about why, or what limits the answer; always there if it does not hold."""

    def __post_init__(self) -> None:
        """Give a claim that does not hold a note, if it has none."""
        if not self.holds and not self.note:
            object.__setattr__(self, "note", OUTSIDE)


def p_text(p: float) -> str:
    """Return a p value as text; its floor is the number of resamples."""
    return f"p = {p:.4f}" if p >= 0.00015 else "p < 0.0002"
