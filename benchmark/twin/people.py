"""People of drawn lifts with other manners, to learn from."""

from typing import Any

import jax
import jax.numpy as jnp
from colift.agents.humans.person import Person
from colift.benchmark.twin.lifts import Lifts


def with_new_manners(person: Person, lifts: Lifts, key: jax.Array, wide: float) -> Lifts:
    """Return lifts with other manners of their people.

    Parameters
    ----------
    person
        The people's rules.
    lifts
        The lifts.
    key
        Draws the manners.
    wide
        Share by which the ranges are longer than the population's; see :class:`.Trait`.
    """
    drawn = jax.random.uniform(key, (len(person.traits), lifts.size))
    manner = {}
    for (name, trait), share in zip(person.traits.items(), drawn, strict=True):
        if trait.wider:
            share = share * (1 + wide) - wide / 2
        number = trait.low + (trait.high - trait.low) * share
        manner[name] = jnp.clip(number, trait.least, trait.most)
    return _replaced(lifts, manner)


def with_quiet_wrists(person: Person, lifts: Lifts) -> Lifts:
    """Return lifts in which the people's wrists show no intention."""
    zero = jnp.zeros(lifts.size)
    return _replaced(lifts, dict.fromkeys(person.shown, zero))


def _replaced(lifts: Lifts, numbers: dict[str, Any]) -> Lifts:
    if not numbers:
        return lifts
    manner = lifts.drawn.manner._replace(**numbers)
    return lifts._replace(drawn=lifts.drawn._replace(manner=manner))
