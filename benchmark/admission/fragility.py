"""The fragility of criteria: whether one policy or one person decides any of them."""

from collections.abc import Sequence
from dataclasses import replace

from colift.benchmark.admission.criteria import Criterion, of_evidence
from colift.benchmark.admission.evidence import Evidence


def with_fragility(evidence: Evidence, criteria: Sequence[Criterion]) -> tuple[Criterion, ...]:
    """Return the criteria, each with the policies and people on which it hangs.

    Each policy and reference, with its other settings, and each person is left out in turn. Of two
    policies or people nobody can be left out.

    Parameters
    ----------
    evidence
        All of it.
    criteria
        The criteria with all of it; those that do not follow from it hang on nobody.
    """
    parts: dict[str, Evidence] = {}
    if len(evidence.policies) > 2:
        parts |= {name: evidence.without(policy=name) for name in evidence.causal}
    if len(evidence.people) > 3:
        parts |= {person: evidence.without(person=person) for person in evidence.people}
    opposite = {each.letter: not each.passed for each in criteria if each.passed is not None}
    hanging: dict[str, list[str]] = {each.letter: [] for each in criteria}
    for name, part in parts.items():
        for each in of_evidence(part):
            if each.passed is not None and each.passed is opposite.get(each.letter):
                hanging[each.letter].append(name)
    return tuple(replace(each, hangs_on=tuple(hanging[each.letter])) for each in criteria)
