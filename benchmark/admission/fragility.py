"""The criteria of a test, and whether one policy, person or pair decides any of them."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Final

from colift.benchmark.admission.criteria import (
    Criterion,
    conventions,
    interaction,
    like_people,
    needs_partner,
    no_free_ride,
    rank_changes,
)
from colift.benchmark.admission.evidence import Evidence

CRITERIA: Final[tuple[Callable[[Evidence], Criterion], ...]] = (
    needs_partner,
    interaction,
    rank_changes,
    conventions,
    like_people,
    no_free_ride,
)
"""The criteria in the order of their letters."""


def judged(
    evidence: Evidence, criteria: Sequence[Callable[[Evidence], Criterion]] = CRITERIA
) -> tuple[Criterion, ...]:
    """Return criteria, each with the policies, people and pairs that decide it."""
    found = [criterion(evidence) for criterion in criteria]
    opposite: dict[str, list[str]] = {each.letter: [] for each in found}
    for name, part in evidence.without_each().items():
        for criterion, whole in zip(criteria, found, strict=True):
            if {whole.passed, criterion(part).passed} == {True, False}:
                opposite[whole.letter].append(name)
    return tuple(replace(each, hangs_on=tuple(opposite[each.letter])) for each in found)
