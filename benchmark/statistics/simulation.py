"""What intervals and ranks promise, counted on simulated boards with people drawn anew.

The true values are known: :func:`coverage` counts the intervals that contain them,
:func:`false_splits` the boards on which equal policies are told apart.
"""

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.benchmark.statistics.estimate import (
    Estimate,
    difference_of_means,
    geometric_ratio,
    log_ratios,
    mean_of,
    paired_difference,
)
from colift.benchmark.statistics.population import ErrorModel
from colift.benchmark.statistics.ranking import all_pairs

LEAST_COVERAGE: Final = 0.92
"""Least share of 95 % intervals that contain the true value."""

MOST_SPLITS: Final = 0.06
"""Largest share of boards on which equal policies are told apart."""

LEVEL_KEEPING: Final = ErrorModel(
    behaviours_mm=(7.3, 19.8, 6.6, 6.3), person=0.16, suiting=0.12, lift=0.16, rest=0.16
)
"""Errors as on ``standard-v1``: two people's in its behaviours; their errors and those of the best
policies vary by 0.11 to 0.24 with the person and by 0.19 to 0.25 with the lift (standard deviation
of the logarithm), of which about half is common to all policies."""

TOUCH: Final = ErrorModel(
    behaviours_mm=(36.2, 24.8, 25.6, 8.4), person=0.35, suiting=0.35, lift=0.25, rest=0.3
)
"""Errors as on the suites with touch, in which people differ more: 0.24 to 0.70 with the person,
0.20 to 0.42 with the lift."""

PEOPLE_SCALE: Final = 1.0
POLICY_SCALE: Final = 0.6
"""Scales of two people and of the policy whose intervals are counted."""


@dataclass(frozen=True, kw_only=True)
class Sample:
    """People drawn for a suite, and the model of their errors."""

    name: str
    model: ErrorModel
    people: int


SAMPLES: Final = (
    Sample(name="like standard-v1", model=LEVEL_KEEPING, people=75),
    Sample(name="like a suite with touch", model=TOUCH, people=25),
    Sample(name="like paper-v1", model=LEVEL_KEEPING, people=5),
    Sample(name="like quick-v1", model=LEVEL_KEEPING, people=3),
)
"""Sizes of the suites; a board's hidden lifts have the size of its public suite."""


@dataclass(frozen=True, kw_only=True)
class Coverage:
    """How often an interval contains the true value."""

    sample: str
    people: int
    quantity: str
    share: float
    suites: int
    """Number of suites that were drawn."""

    @property
    def holds(self) -> bool:
        """Whether it is at least :data:`LEAST_COVERAGE`."""
        return self.share >= LEAST_COVERAGE


@dataclass(frozen=True, kw_only=True)
class Board:
    """Policies of a board: ``groups`` of ``equals`` each."""

    name: str
    groups: int
    equals: int


BOARDS: Final = (
    Board(name="15 equal policies", groups=1, equals=15),
    Board(name="7 pairs of equals", groups=7, equals=2),
    Board(name="5 triples of equals", groups=5, equals=3),
)

APART: Final = 1.5
"""Error of a group of equals, relative to that of the group before it."""

BOARD_SAMPLES: Final = SAMPLES[:2]
"""Sizes of boards."""


@dataclass(frozen=True, kw_only=True)
class Splits:
    """How often equal policies are told apart."""

    board: str
    sample: str
    people: int
    share: float
    boards: int
    """Number of boards that were drawn."""

    @property
    def holds(self) -> bool:
        """Whether it is at most :data:`MOST_SPLITS`."""
        return self.share <= MOST_SPLITS


def coverage(
    sample: Sample,
    suites: int,
    *,
    seed: int = 0,
    progress: Callable[[int], None] = lambda suites: None,
) -> Iterator[Coverage]:
    """Yield the coverage of each printed quantity, over drawn suites.

    Parameters
    ----------
    sample
        Their people.
    suites
        Number of suites.
    seed
        Seed of the draws.
    progress
        Called with 1 after each suite.
    """
    model, units = sample.model, sample.model.units(sample.people)
    rng = np.random.default_rng((seed, sample.people))
    scales = np.array([POLICY_SCALE, PEOPLE_SCALE])
    truth = {
        "RMSE": POLICY_SCALE * model.mean_mm,
        "difference": (POLICY_SCALE - PEOPLE_SCALE) * model.mean_mm,
        "vs_human": POLICY_SCALE / PEOPLE_SCALE,
        "gap": 1.0,
    }
    hits = dict.fromkeys(truth, 0)
    for _ in range(suites):
        mine, human = model.draw(scales, sample.people, rng)
        public, public_human = model.draw(scales, sample.people, rng)
        logs = log_ratios(mine, human), log_ratios(public, public_human)
        found = {
            "RMSE": mean_of(mine, units),
            "difference": paired_difference(mine, human, units),
            "vs_human": geometric_ratio(mine, human, units),
            "gap": difference_of_means(logs[0], units, logs[1], units).exponential(),
        }
        for name, estimate in found.items():
            hits[name] += _contains(estimate, truth[name])
        progress(1)
    for name, count in hits.items():
        yield Coverage(
            sample=sample.name,
            people=sample.people,
            quantity=name,
            share=count / suites,
            suites=suites,
        )


def false_splits(
    board: Board,
    sample: Sample,
    boards: int,
    *,
    seed: int = 0,
    progress: Callable[[int], None] = lambda boards: None,
) -> Splits:
    """Return how often any two equal policies are told apart, over drawn boards.

    A rank is then too high: it counts a policy as better that is not.

    Parameters
    ----------
    board, sample
        Its policies, and the people of its hidden lifts.
    boards
        Number of boards.
    seed
        Seed of the draws.
    progress
        Called with 1 after each board.
    """
    model, units = sample.model, sample.model.units(sample.people)
    rng = np.random.default_rng((seed, sample.people, board.groups))
    scales = np.repeat(APART ** np.arange(board.groups), board.equals)
    names = [str(i) for i in range(len(scales))]
    groups = (names[i : i + board.equals] for i in range(0, len(names), board.equals))
    equal = [pair for group in groups for pair in itertools.combinations(group, 2)]
    wrong = 0
    for _ in range(boards):
        errors = model.draw(scales, sample.people, rng)
        family = all_pairs(dict(zip(names, errors, strict=True)), units)
        wrong += any(family.apart(*pair) for pair in equal)
        progress(1)
    return Splits(
        board=board.name,
        sample=sample.name,
        people=sample.people,
        share=wrong / boards,
        boards=boards,
    )


def _contains(estimate: Estimate, value: float) -> bool:
    low, high = estimate.ends
    return low <= value <= high
