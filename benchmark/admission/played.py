"""The errors of a test of admission: each player with each person, lift by lift."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final, Self

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import FloatArray

LEAST_PEOPLE: Final = 3
"""Fewest people whom a test needs: without one of them, two have to differ."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Played:
    """The errors of players with people, on the same lifts.

    Raises
    ------
    InputError
        If there are too few people or lifts of each, or an error is not a positive number.
    """

    players: tuple[str, ...]
    people: tuple[str, ...]
    errors: FloatArray
    """(players, people, lifts) RMSE [mm]; the lifts of a person in the suite's order: behaviours,
    then seeds."""

    def __post_init__(self) -> None:
        """Check shape and values."""
        if len(self.people) < LEAST_PEOPLE - 1 or self.errors.shape[-1] < 2:
            raise InputError(
                f"admission needs {LEAST_PEOPLE} people or more with 2 lifts or more each, got "
                f"{len(self.people)} people with {self.errors.shape[-1]}"
            )
        if not (np.isfinite(self.errors).all() and self.errors.min() > 0):
            raise InputError("admission needs a positive error in every lift")

    @classmethod
    def of(cls, tables: Mapping[str, ScoreTable]) -> Self:
        """Return the errors of score tables of one suite.

        Raises
        ------
        InputError
            If not every person has the same number of lifts with every behaviour.
        """
        strata = next(iter(tables.values())).strata
        people = tuple(dict.fromkeys(person for _, person in strata))
        order = {
            who: [i for i, (_, person) in enumerate(strata) if person == who] for who in people
        }
        kinds = {tuple(sorted(strata[i][0] for i in lifts)) for lifts in order.values()}
        if len(kinds) != 1:
            raise InputError("admission needs lifts of every person with every behaviour")
        if len(people) < LEAST_PEOPLE:
            raise InputError(f"admission needs {LEAST_PEOPLE} people or more, got {len(people)}")
        index = np.array([order[who] for who in people])
        errors = np.array([np.asarray(table.rmse_mm)[index] for table in tables.values()])
        return cls(players=tuple(tables), people=people, errors=errors)

    def part(self, players: Sequence[str]) -> Self:
        """Return the errors of some players, in this order."""
        rows = [self.players.index(name) for name in players]
        return replace(self, players=tuple(players), errors=self.errors[rows])

    def without(self, *, players: Collection[str] = (), person: str | None = None) -> Self:
        """Return the errors without some players, and without a person."""
        kept = self.part([name for name in self.players if name not in players])
        columns = [i for i, each in enumerate(kept.people) if each != person]
        return replace(
            kept, people=tuple(kept.people[i] for i in columns), errors=kept.errors[:, columns]
        )

    @property
    def by_person(self) -> FloatArray:
        """Mean error of each player with each person [mm], (players, people)."""
        means: FloatArray = self.errors.mean(axis=-1)
        return means

    @property
    def typical(self) -> dict[str, float]:
        """Geometric mean of each player's errors [mm]: the ratio of two is that of their lifts.

        A person with whom everybody fails is one person here, and most of an arithmetic mean.
        """
        means: list[float] = np.exp(np.log(self.errors).mean(axis=(1, 2))).tolist()
        return dict(zip(self.players, means, strict=True))

    @property
    def means(self) -> dict[str, float]:
        """Mean error of each player [mm]."""
        means: list[float] = self.by_person.mean(axis=-1).tolist()
        return dict(zip(self.players, means, strict=True))
