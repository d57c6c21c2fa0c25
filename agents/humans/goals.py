"""Goal errors of live lifts: the distance of the hand from each goal when it had to be there."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import fmean
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans.cued import SETTLING, Cued

SETTLED: Final = SETTLING / 2
"""Time before the next goal, or before the end, in which the hand must be at a goal [s]: half of
what the cues leave for settling. The other half is for slow hands and slow connections."""

NEAR: Final = 0.020
"""Largest goal error of a goal that counts as reached [m]: a tenth of a usual lift, and the
distance by which the metrics decide it of simulated people (``REACHED``)."""


@dataclass(frozen=True, kw_only=True)
class GoalError:
    """How far the hand was from one goal when it had to be there."""

    name: str
    """The goal in a sentence: ``the line``, ``the first line``, ``the height of rest``."""
    error: float
    """Mean distance of the hand from the goal in the last :data:`SETTLED` before the next goal
    appeared, or before the end of the lift [m]."""

    @property
    def missed(self) -> bool:
        """Whether the goal was not reached, or not held until the next one appeared."""
        return self.error > NEAR


def goal_errors(cue: Cued, references: Sequence[float]) -> tuple[GoalError, ...]:
    """Return the error of each goal of a complete lift, in order.

    The hand counts and not the table's end: the partner at the other end cannot move it, so that
    no partner loses or wins lifts by it. A goal that is replaced while the hand is on its way, the
    first one of ``changing_goal``, need not be reached.

    Parameters
    ----------
    cue
        The goals.
    references
        Height of the hand above the grip in each frame of the lift [m], at least one.
    """
    cues = cue.cues()
    ends = [*(each.frame for each in cues[1:]), len(references)]
    judged = [*zip(cues, ends, strict=True)][int(cue.kind == "changing_goal") :]
    hand, last = np.asarray(references, dtype=np.float64), len(references) - 1
    found = []
    for (goal, end), name in zip(judged, _names(len(judged)), strict=True):
        frames = np.arange(end - round(SETTLED / FRAME), end).clip(0, last)
        error = fmean(np.abs(hand[frames] - goal.height).tolist())
        found.append(GoalError(name=name, error=error))
    return tuple(found)


def goal_error_mm(errors: Sequence[GoalError]) -> float:
    """Return the goal error of a lift: the mean over its goals [mm]."""
    return 1000 * fmean(each.error for each in errors)


def missed_words(errors: Sequence[GoalError]) -> str | None:
    """Return the reason why a lift is void, the first missed goal; None if none was missed."""
    first = next((each for each in errors if each.missed), None)
    if first is None:
        return None
    return (
        f"{first.name} was not reached and held (the hand was {1000 * first.error:.0f} mm away; at "
        f"most {1000 * NEAR:.0f} mm count)"
    )


def _names(goals: int) -> list[str]:
    """Return the names of so many goals, of which the last is the height of rest."""
    lines = ["the line"] if goals == 2 else ["the first line", "the second line"]
    return [*lines, "the height of rest"]
