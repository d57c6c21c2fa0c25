"""What a suite is judged by: the errors of all players, and what each player stands for."""

from dataclasses import dataclass, replace
from typing import Self

from colift.benchmark.admission.played import Played


@dataclass(frozen=True, kw_only=True, eq=False)
class Evidence:
    """The errors of a test of admission, and the parts that its players have."""

    played: Played
    """Everybody: policies and references, other settings, the idle robot and two people."""
    policies: tuple[str, ...]
    """The registered policies, as they are."""
    references: tuple[str, ...]
    """Trained references, which are in no registry."""
    settings: tuple[str, ...]
    """Policies with other settings; see :func:`.other_settings`."""
    alone: frozenset[str]
    """Those policies and references that are blind to the partner; see :func:`.acts_alone`."""
    idle: str
    """The robot that does nothing."""
    two_people: str
    """Two people."""

    @property
    def causal(self) -> tuple[str, ...]:
        """All robots that know no more than a policy may."""
        return self.policies + self.references

    @property
    def people(self) -> tuple[str, ...]:
        """Names of the people."""
        return self.played.people

    def without(self, *, policy: str | None = None, person: str | None = None) -> Self:
        """Return the evidence without a policy, with all its settings, and without a person."""
        gone = {name for name in self.played.players if name.partition(",")[0] == policy}

        def kept(names: tuple[str, ...]) -> tuple[str, ...]:
            return tuple(name for name in names if name not in gone)

        return replace(
            self,
            played=self.played.without(players=gone, person=person),
            policies=kept(self.policies),
            references=kept(self.references),
            settings=kept(self.settings),
            alone=self.alone - gone,
        )
