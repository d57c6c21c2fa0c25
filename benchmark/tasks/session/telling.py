"""The habits of a person as numbers, for a reference that is told them."""

from typing import Final

from colift.agents.humans import Subject
from colift.benchmark.tasks.session.usual import AT, HOLD, LENGTH, SIZE, WAIT, WAYS, usual_lift

TOLD: Final = 8 + len(WAYS)
"""Number of numbers."""


def habits_told(subject: Subject, place: int) -> list[float]:
    """Return a person's habits in a lift of a session, as numbers of the order of 1."""
    usual = usual_lift(subject, place)
    within = (
        (usual.wait, WAIT),
        (usual.hold, HOLD),
        (usual.at, AT),
        (usual.length, LENGTH),
        (usual.size, SIZE),
    )
    return [
        *(2.0 * (number - low) / (high - low) - 1.0 for number, (low, high) in within),
        20.0 * (usual.height - 0.24),
        3.0 * (usual.up - 2.1),
        3.0 * (usual.down - 2.1),
        *(float(usual.way == each) for each in WAYS),
    ]
