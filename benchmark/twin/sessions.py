"""Sessions in the twin: lifts in a row, of people who remember, with a policy that may."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.session.acquaintance import (
    STRANGER,
    Acquaintance,
    after_lift,
    impression,
)
from colift.benchmark.twin.drawing import draw_lift, stack
from colift.benchmark.twin.functions import LIFTS
from colift.benchmark.twin.lifts import Lifts
from colift.benchmark.twin.policy import Policy
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin

LONGEST = 16.0
"""Time after which a lift is cut off [s]."""


class SessionOutcome(NamedTuple):
    """Figures of k lifts of each of n sessions."""

    rmse_mm: jax.Array
    """(k, n) [mm]"""
    known: Acquaintance[jax.Array]
    """(k, n) what the people know after each lift."""


def draw_sessions(people: Sequence[tuple[Scenario, Sequence[int]]]) -> Lifts:
    """Return the lifts of sessions, with a first axis of places: those that the engine plays.

    Parameters
    ----------
    people
        Scenario and seeds of each session; see :class:`.Serial`.

    Raises
    ------
    InputError
        As :func:`.draw_lifts`.
    """
    suites = [Suite(name="", scenarios=(each,), seeds=tuple(seeds)) for each, seeds in people]
    count, many = len(people[0][1]), len(people)
    due = (suite.at(place) for place in range(count) for suite in suites)
    lifts = stack([draw_lift(each.scenario, each.seed, None, LONGEST) for each in due])

    def by_place(array: jax.Array) -> jax.Array:
        return jnp.moveaxis(array.reshape(*array.shape[:-1], count, many), -2, 0)

    found: Lifts = jax.tree.map(by_place, lifts)
    return found


def play_sessions(
    twin: TaskTwin,
    policy: Policy,
    memory: Any,
    between: Callable[[Any], Any],
    sessions: Lifts,
    told: jax.Array | None = None,
) -> SessionOutcome:
    """Return the outcome of sessions with a policy; differentiable in all arrays.

    Parameters
    ----------
    twin
        The rules of the lifts.
    policy, memory
        The policy, and its memory at the beginning of n sessions.
    between
        Returns the memory at the beginning of a lift, from that at the end of the one before.
    sessions
        Lifts with a first axis of places; see :func:`draw_sessions`.
    told
        (k, s, m, n) numbers that follow the observation; see :func:`.rollout`.
    """
    zero = jnp.zeros(sessions.steps.shape[-1])
    stranger = Acquaintance(*(zero + number for number in STRANGER))

    def lift(held: tuple[Any, Any], now: tuple[Lifts, Any]) -> tuple[tuple[Any, Any], Any]:
        (memory, known), (lifts, extra) = held, now
        manner = lifts.drawn.manner._replace(lag=known.lag, trust=known.trust)
        lifts = lifts._replace(drawn=lifts.drawn._replace(manner=manner))
        found = rollout(twin, policy, memory, lifts, told=extra, seen=True)
        assert found.seen is not None
        known = after_lift(LIFTS, known, impression(LIFTS, found.seen.near, found.seen.far))
        return (between(found.seen.memory), known), (found.rmse_mm, known)

    _, outcome = jax.lax.scan(lift, (memory, stranger), (sessions, told))
    return SessionOutcome(*outcome)
