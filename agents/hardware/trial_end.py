"""Ends of a trial: after a fixed duration, or after a lift."""

from collections import deque
from dataclasses import dataclass, field
from typing import Final, Protocol

from colift.agents.hardware.plausibility import seen
from colift.agents.hardware.ports import Sample
from colift.agents.hardware.trial_log import Step, TrialLog

RISEN: Final = 0.05
"""Height of the human's end [m] above which a lift has begun."""

DOWN: Final = 0.02
"""Height of the human's end [m] below which the table is down again."""

STILL: Final = 0.005
"""Range of the human's end [m] within which it is at rest."""


class TrialEnd(Protocol):
    """Criterion for the end of a trial."""

    def over(self, log: TrialLog) -> bool:
        """Return whether the trial has reached its end; called before each step."""


@dataclass(kw_only=True)
class AfterDuration:
    """A trial of a fixed length."""

    duration: float
    """[s]"""

    def over(self, log: TrialLog) -> bool:
        """Return whether the next deadline is at the duration or beyond."""
        last = log.events[-1] if log.events else None
        if not isinstance(last, Step):
            return False
        return last.deadline + log.period > log.start + self.duration - log.period / 2


@dataclass(kw_only=True)
class AfterLift:
    """A trial that ends when the table has been lifted, lowered again and at rest for a while."""

    rest: float = 1.0
    """Duration of that rest [s]."""
    longest: float = 30.0
    """Longest trial, whatever the table does [s]."""
    _recent: deque[Sample] = field(default_factory=deque)
    _read: int = 0
    _risen: bool = False

    def over(self, log: TrialLog) -> bool:
        """Return whether the table is down and at rest after a lift."""
        recent, newest = self._recent, log.events[self._read :]
        self._read = len(log.events)
        for event in newest:
            if isinstance(event, Step):
                if event.time - log.start > self.longest:
                    return True
            elif seen(event) and (not recent or event.time > recent[-1].time):
                self._risen |= event.human_end > RISEN
                recent.append(event)
        if not recent or recent[-1].time - recent[0].time < self.rest:
            return False
        while recent[-1].time - recent[1].time >= self.rest:
            recent.popleft()
        heights = [sample.human_end for sample in recent]
        return self._risen and max(heights) < DOWN and max(heights) - min(heights) < STILL
