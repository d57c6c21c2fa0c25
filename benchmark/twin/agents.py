"""Lifts of the twin with unchanged agents: policies and people as they play in the engine."""

from collections.abc import Callable, Sequence
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.agent import FRAME, HISTORY, Agent, HumanObservation
from colift.agents.humans import SecondPerson
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seat import HUMANS, body_parameters, within_range
from colift.benchmark.episode.turns import policy_seed
from colift.benchmark.twin.body import bodies, pushed
from colift.benchmark.twin.drawing import draw_lifts
from colift.benchmark.twin.lifts import Share, chunk, shares
from colift.benchmark.twin.pair import advance_pair, pair_at_rest
from colift.benchmark.twin.task_twin import Missed, TaskTwin
from colift.benchmark.twin.view import LiftState
from colift.benchmark.world.table import WEIGHT_SHARE
from numpy.typing import NDArray

Array = NDArray[np.float64]


def play_agents(make: Callable[[], Agent], lifts: Sequence[tuple[Scenario, int]]) -> Array:
    """Return the score [mm] of each lift (n,) with an agent at the robot's end, in the twin.

    Parameters
    ----------
    make
        Returns a new agent.
    lifts
        Scenarios of one task with a NAO, and seeds.
    """
    twin, drawn = TaskTwin.of([scenario for scenario, _ in lifts]), draw_lifts(lifts)
    agents = [make() for _ in lifts]
    for agent in agents:
        agent.reset(policy_seed())
    due, last = shares(drawn), drawn.longest - 1

    def share(number: jax.Array) -> Share:
        found: Share = jax.tree.map(lambda each: each[jnp.minimum(number, last)], due)
        return found

    @jax.jit
    def step(state: LiftState, actions: jax.Array) -> tuple[LiftState, Missed, jax.Array]:
        later, ends = twin.step(state, drawn, share(state.step), actions)
        missed = twin.missed(state, later, drawn, ends)
        return later, missed, twin.observe(later, drawn, share(later.step))

    state = twin.at_rest(drawn)
    view = twin.observe(state, drawn, share(state.step))
    steps, found = np.asarray(drawn.steps), []
    actions = np.zeros(len(lifts), np.float32)
    for number in range(drawn.longest):
        views = np.asarray(view, np.float64)
        for index in np.flatnonzero(number < steps):
            actions[index] = np.asarray(agents[index].act(views[:, index])).ravel()[0]
        state, missed, view = step(state, jnp.asarray(actions))
        found.append(missed)
    return np.asarray(twin.score_mm(drawn, jax.tree.map(lambda *each: jnp.stack(each), *found)))


def play_pairs(lifts: Sequence[tuple[Scenario, int]]) -> Array:
    """Return the RMSE [mm] of each lift (n,) of two people, in the twin.

    The second person is :class:`.SecondPerson`, unchanged: it gets the observations of the task.
    """
    twin, drawn = TaskTwin.of([scenario for scenario, _ in lifts]), draw_lifts(lifts)
    count, size, many = drawn.size, drawn.frames, chunk(drawn.frames)
    person = HUMANS["human"].person
    body = bodies([body_parameters(person)] * count)
    delays = round(person.visual_delay / FRAME), round(person.haptic_delay / FRAME)
    partners = [SecondPerson(subject=person) for _ in lifts]
    for partner in partners:
        partner.reset(policy_seed())
    due, steps = shares(drawn), np.asarray(drawn.steps)

    @jax.jit
    def step(state: LiftState, far: jax.Array) -> tuple[LiftState, jax.Array]:
        share = jax.tree.map(lambda each: each[state.step], due)
        memory, intention, hand, references = twin.intended(state, drawn, share)
        pair, squares = state.table, jnp.zeros(count)
        for first in range(0, size, many):
            frames = slice(first, first + many)
            pair = advance_pair(pair, drawn.body, body, references[frames], far[frames])
            squares = squares + (pair.differences[:many] ** 2).sum(axis=0)
        intentions = jax.tree.map(pushed, state.intentions, intention)
        after = LiftState(pair, state.command, hand, memory, intentions, state.lost, state.step + 1)
        return after, squares

    state = twin.at_rest(drawn)._replace(table=pair_at_rest(count))
    total, far = np.zeros(count), np.zeros((size, count))
    for number in range(drawn.longest):
        views = _partner_views(state.table, delays, size, number)
        for index in np.flatnonzero(number < steps):
            far[:, index] = within_range(partners[index].act(views[index]).tolist())
        state, squares = step(state, jnp.asarray(far, jnp.float32))
        total += np.where(number < steps, np.asarray(squares, np.float64), 0.0)
    return np.asarray(1000 * np.sqrt(total / (steps * size)))


def _partner_views(pair: Any, delays: tuple[int, int], size: int, step: int) -> Array:
    """Return the observations of the second persons (n, HumanObservation.size(f)).

    ``delays`` are those of sight and of touch, in frames.
    """
    seen, felt = delays
    forces = np.asarray(pair.far_forces, np.float64)[felt : felt + HISTORY]
    heights = np.asarray(pair.heights, np.float64)
    far = heights + np.asarray(pair.differences, np.float64)
    views = np.zeros((heights.shape[1], HumanObservation.size(size)))
    views[:, HumanObservation.OWN_HEIGHT] = far[:HISTORY][::-1].T
    views[:, HumanObservation.OTHER_END] = heights[seen : seen + HISTORY][::-1].T
    views[:, HumanObservation.HAND_FORCE] = WEIGHT_SHARE + forces[::-1].T
    views[:, HumanObservation.TARGET] = heights[seen][:, np.newaxis]
    views[:, HumanObservation.TIME] = step * size * FRAME
    return views
