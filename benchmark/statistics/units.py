"""The sampling units of a set of episodes: people, each with all of their episodes.

A person is the same in all of their episodes: two episodes with one person say less than one
episode with each of two. All episodes of a person therefore stay together, in intervals and in
tests, which hold for other people from the same population.
"""

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.statistics.samples import FloatArray
from numpy.typing import ArrayLike, NDArray

IntArray = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Units:
    """The units of n episodes, in groups whose shares of the episodes are fixed.

    A group with a single unit would count as certain: such groups are joined with each other, or
    the only one with the smallest other group (collapsed strata; Cochran 1977, section 5A.12). That
    adds the difference of the groups to the variance, and errs to the safe side.
    """

    unit: IntArray
    """Unit of each episode, shape (n,): 0 to k - 1."""
    group: IntArray
    """Group of each unit, shape (k,)."""

    @classmethod
    def people(cls, episodes: Iterable[tuple[Hashable, Hashable]]) -> Self:
        """Return the people of some episodes, each given as (behaviour, person).

        People who appear in the same behaviours are a group: of every person in all behaviours
        there is one, of people with a behaviour of their own, one for each behaviour.
        """
        behaviours: dict[Hashable, set[Hashable]] = {}
        people = []
        for behaviour, person in episodes:
            people.append(person)
            behaviours.setdefault(person, set()).add(behaviour)
        return cls._labelled(people, [frozenset(behaviours[each]) for each in behaviours])

    @classmethod
    def episodes(cls, groups: Iterable[Hashable]) -> Self:
        """Return the episodes as units of their own, each given as its group.

        For people who are fixed, such as the five of the paper's Table I: what is found holds for
        other lifts of these people, and not for others.
        """
        labels = list(groups)
        return cls._labelled(range(len(labels)), labels)

    @classmethod
    def _labelled(cls, units: Iterable[Hashable], groups: Sequence[Hashable]) -> Self:
        """Return units from the label of each episode's, and the group of each in its order."""
        unit, group = _numbered(units), _numbered(groups)
        return cls(unit, _joined(group))

    def select(self, episodes: ArrayLike) -> Self:
        """Return the units of the episodes with these indices, in the same groups."""
        kept, unit = np.unique(self.unit[np.asarray(episodes, dtype=np.intp)], return_inverse=True)
        return type(self)(unit.astype(np.intp), _joined(_numbered(self.group[kept].tolist())))

    @property
    def count(self) -> int:
        """Number of units k."""
        return len(self.group)

    @property
    def freedom(self) -> int:
        """Degrees of freedom of a variance between units: their number minus that of groups."""
        return self.count - len(set(self.group.tolist()))

    @property
    def sizes(self) -> FloatArray:
        """Number of episodes of each unit, shape (k,)."""
        return np.bincount(self.unit, minlength=self.count).astype(np.float64)

    def sums(self, values: FloatArray) -> FloatArray:
        """Return the sum of each unit's values, shape (..., k), of values of shape (..., n).

        Raises
        ------
        InputError
            If there is not one value for each episode.
        """
        if values.shape[-1] != len(self.unit):
            raise InputError(
                f"there are units of {len(self.unit)} episodes for {values.shape[-1]} values; each "
                "value needs its person"
            )
        order = self.unit.argsort(kind="stable")
        first = np.searchsorted(self.unit[order], np.arange(self.count))
        found: FloatArray = np.add.reduceat(values[..., order], first, axis=-1)
        return found

    def standard_error(self, values: FloatArray) -> float | None:
        r"""Return the standard error of the mean of n values; None if one unit is all there is.

        With the sum :math:`e_u` of the deviations of unit u's values from their mean, the
        :math:`k_g` units of group g, and the mean :math:`\bar e_g` over them,

        .. math:: s^2 = \frac{1}{n^2} \sum_g \frac{k_g}{k_g - 1}
            \sum_{u \in g} (e_u - \bar e_g)^2
        """
        if self.freedom == 0:
            return None
        deviations = self.sums(values) - values.mean() * self.sizes
        many = np.bincount(self.group).astype(np.float64)
        deviations -= (np.bincount(self.group, deviations) / many)[self.group]
        factors = (many / np.maximum(many - 1.0, 1.0))[self.group]
        return float(np.sqrt((factors * deviations**2).sum())) / len(values)


def _numbered(labels: Iterable[Hashable]) -> IntArray:
    """Return the number of each label, in order of appearance."""
    known: dict[Hashable, int] = {}
    return np.array([known.setdefault(each, len(known)) for each in labels], dtype=np.intp)


def _joined(group: IntArray) -> IntArray:
    """Return the groups of units, those with a single one joined."""
    sizes = np.bincount(group)
    single = np.flatnonzero(sizes == 1)
    if not single.size or len(sizes) == 1:
        return group
    others = np.flatnonzero(sizes > 1)
    into = single[0] if single.size > 1 else others[sizes[others].argmin()]
    joined = np.where(np.isin(group, single), into, group)
    return _numbered(joined.tolist())
