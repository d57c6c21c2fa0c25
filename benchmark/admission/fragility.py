"""The criteria of a test, and whether one policy, person or pair decides any of them."""

from collections.abc import Callable
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


def judged(evidence: Evidence) -> tuple[Criterion, ...]:
    """Return all criteria, each with the policies, people and pairs that decide it."""
    criteria = [criterion(evidence) for criterion in CRITERIA]
    opposite: dict[str, list[str]] = {each.letter: [] for each in criteria}
    for name, part in evidence.without_each().items():
        for criterion, whole in zip(CRITERIA, criteria, strict=True):
            passed = {whole.passed, criterion(part).passed}
            if passed == {True, False}:
                opposite[whole.letter].append(name)
    return tuple(replace(each, hangs_on=tuple(opposite[each.letter])) for each in criteria)
