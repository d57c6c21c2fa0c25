"""The fragility of verdicts: whether one policy or one person decides any of them."""

from collections.abc import Sequence
from dataclasses import dataclass

from colift.benchmark.admission.criteria import Criterion, of_evidence
from colift.benchmark.admission.evidence import Evidence


@dataclass(frozen=True, kw_only=True)
class Fragile:
    """A verdict that is another one without a policy or a person."""

    letter: str
    without: str
    passes: bool
    """Whether the criterion passes without it."""

    def __str__(self) -> str:
        """Return it in words."""
        return f"without {self.without}, {self.letter} {'passes' if self.passes else 'fails'}"


def fragile_verdicts(evidence: Evidence, criteria: Sequence[Criterion]) -> tuple[Fragile, ...]:
    """Return what changes a verdict if it is left out; nothing should.

    Each policy and reference, with its other settings, and each person is left out in turn. Of two
    policies or people nobody can be left out.

    Parameters
    ----------
    evidence
        All of it.
    criteria
        The criteria with all of it; those that do not follow from it are not judged anew.
    """
    verdicts = {each.letter: each.passed for each in criteria}
    found: list[Fragile] = []
    for name in evidence.causal if len(evidence.policies) > 2 else ():
        found += _changed(name, verdicts, evidence.without(policy=name))
    for person in evidence.people if len(evidence.people) > 3 else ():
        found += _changed(person, verdicts, evidence.without(person=person))
    return tuple(found)


def _changed(name: str, verdicts: dict[str, bool | None], evidence: Evidence) -> list[Fragile]:
    return [
        Fragile(letter=each.letter, without=name, passes=each.passed)
        for each in of_evidence(evidence)
        if each.passed is not None and each.passed != verdicts[each.letter]
    ]
