"""The size of a data set, counted while it is written."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from colift.benchmark.export.lifts import ExportedLift


@dataclass(kw_only=True)
class Contents:
    """Counts of the lifts of a data set."""

    lifts: int = 0
    steps: int = 0
    dropped: int = 0
    """Lifts in which the table was dropped."""
    empty: int = 0
    """Lifts without a step, which are left out: the policy failed before its first action."""
    behaviours: dict[str, int] = field(default_factory=dict)
    """Lifts by behaviour."""
    first_seed: int = 0
    last_seed: int = 0

    def counted(self, lifts: Iterable[ExportedLift]) -> Iterator[ExportedLift]:
        """Yield the lifts that have a step, and count all."""
        for lift in lifts:
            if not lift.steps:
                self.empty += 1
                continue
            self.first_seed = lift.seed if not self.lifts else min(self.first_seed, lift.seed)
            self.last_seed = max(self.last_seed, lift.seed)
            self.lifts += 1
            self.steps += lift.steps
            self.dropped += lift.dropped is not None
            self.behaviours[lift.behaviour] = self.behaviours.get(lift.behaviour, 0) + 1
            yield lift
