"""Lifts with people on whom nothing was learned or tuned."""

from typing import Final

from colift.base.errors import InputError
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.ranges import FIRST_NEW_PERSON
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import BEHAVIOURS

FIRST_SEED: Final = FIRST_NEW_PERSON
"""Seed of the first person and of the first lift: no learning takes seeds from here on."""


def held_out_suite(people: int, lifts: int, first_seed: int = FIRST_SEED) -> Suite:
    """Return the suite of every behaviour with new people.

    Parameters
    ----------
    people
        Number of people: ``Subject.draw`` of the seeds from ``first_seed`` on.
    lifts
        Number of lifts with each person on each behaviour, with the seeds from ``first_seed`` on.
    first_seed
        From :data:`FIRST_SEED` on.

    Raises
    ------
    InputError
        If there are no people or no lifts, or the seed is one for learning.
    """
    if people < 1 or lifts < 1:
        raise InputError(f"at least 1 person and 1 lift are needed, got {people} and {lifts}")
    if first_seed < FIRST_SEED:
        raise InputError(
            f"seeds of new people start at {FIRST_SEED}, those below are for learning; "
            f"got {first_seed}"
        )
    scenarios = tuple(
        make_scenario(behaviour, f"draw-{seed}")
        for behaviour in BEHAVIOURS
        for seed in range(first_seed, first_seed + people)
    )
    name = f"{people} new people x {len(BEHAVIOURS)} behaviours x {lifts} lifts"
    return Suite(name=name, scenarios=scenarios, seeds=tuple(range(first_seed, first_seed + lifts)))
