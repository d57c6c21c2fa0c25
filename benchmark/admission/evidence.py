"""What a suite is judged by: the errors of all players, and what each player stands for."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from colift.benchmark.admission.played import Played
from colift.benchmark.admission.published import Compared
from colift.benchmark.statistics import FloatArray


@dataclass(frozen=True, kw_only=True, eq=False)
class Evidence:
    """The errors of a test of admission, the parts that its players have, and other figures."""

    played: Played
    """Everybody: policies and references, other settings, the idle robot and two people."""
    policies: tuple[str, ...]
    """The registered policies, as they are."""
    references: tuple[str, ...] = ()
    """Trained references, which are in no registry."""
    settings: tuple[str, ...] = ()
    """Policies with other settings; see :func:`.other_settings`."""
    alone: frozenset[str] = frozenset()
    """Those policies and references that are blind to the partner; see :func:`.acts_alone`."""
    idle: str = ""
    """The robot that does nothing, if it plays."""
    two_people: str = ""
    """Two people, if they play."""
    pairs: FloatArray | None = None
    """(n, n) mean RMSE of each person with each robot of n pairs that were trained, three or more
    [mm]; None: no pair was trained."""
    compared: Compared | None = None
    """The published figure, and that of two simulated people; None if there is none."""
    not_compared: str = ""
    """Why there is no published figure, in words."""

    @property
    def causal(self) -> tuple[str, ...]:
        """All robots that know no more than a policy may."""
        return self.policies + self.references

    @property
    def people(self) -> tuple[str, ...]:
        """Names of the people."""
        return self.played.people

    def without_each(self) -> Mapping[str, Self]:
        """Return the evidence without each policy and reference, each person, and each pair.

        A policy goes with its other settings. Of two policies, or three people or pairs, nobody can
        be left out.
        """
        parts: dict[str, Self] = {}
        if len(self.policies) > 2:
            parts |= {name: self._without_policy(name) for name in self.causal}
        if len(self.people) > 3:
            parts |= {name: self._without_person(name) for name in self.people}
        if self.pairs is not None and len(self.pairs) > 3:
            parts |= {
                f"pair {i + 1}": replace(self, pairs=without_pair(self.pairs, i))
                for i in range(len(self.pairs))
            }
        return parts

    def _without_policy(self, name: str) -> Self:
        gone = {each for each in self.played.players if each.partition(",")[0] == name}

        def kept(names: tuple[str, ...]) -> tuple[str, ...]:
            return tuple(each for each in names if each not in gone)

        return replace(
            self,
            played=self.played.without(players=gone),
            policies=kept(self.policies),
            references=kept(self.references),
            settings=kept(self.settings),
            alone=self.alone - gone,
        )

    def _without_person(self, name: str) -> Self:
        compared = None if self.compared is None else self.compared.without(name)
        return replace(self, played=self.played.without(person=name), compared=compared)


def without_pair(errors: FloatArray, number: int) -> FloatArray:
    """Return the errors of each person with each robot of pairs, without those of one pair."""
    return np.delete(np.delete(errors, number, 0), number, 1)
