"""Lifts of the twin with unchanged agents: policies and people as they play in the engine."""

from collections.abc import Callable, Sequence
from functools import partial

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.agent import FRAME, HISTORY, Agent, HumanObservation
from colift.agents.humans import SecondPerson
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seat import HUMANS, within_range
from colift.benchmark.episode.turns import policy_seed
from colift.benchmark.twin import pair as pair_plant
from colift.benchmark.twin import playing as lifting
from colift.benchmark.twin.lifts import Lifts, draw_lifts, partner_body
from colift.benchmark.twin.playing import Due, Frames, LiftState, in_chunks
from colift.benchmark.world.table import WEIGHT_SHARE
from numpy.typing import NDArray

Array = NDArray[np.float64]


def play_agents(make: Callable[[], Agent], lifts: Sequence[tuple[Scenario, int]]) -> Array:
    """Return the RMSE [mm] of each lift (n,) with an agent at the robot's end, in the twin.

    Parameters
    ----------
    make
        Returns a new agent.
    lifts
        Scenarios with a NAO, and seeds.
    """
    drawn = draw_lifts(lifts)
    agents = [make() for _ in lifts]
    for agent in agents:
        agent.reset(policy_seed())
    period = lifts[0][0].control_period
    step = jax.jit(partial(_step, drawn, period))
    state = lifting.at_rest(drawn.size)
    view = lifting.observe(state, drawn.noise[0], drawn.latency, period)
    steps = np.asarray(drawn.steps)
    squares, actions = np.zeros(len(lifts)), np.zeros(len(lifts), np.float32)
    for number in range(drawn.longest()):
        views = np.asarray(view, np.float64)
        for index in np.flatnonzero(number < steps):
            actions[index] = np.asarray(agents[index].act(views[:, index])).ravel()[0]
        state, view, added = step(state, jnp.asarray(actions))
        squares += np.where(number < steps, np.asarray(added, np.float64), 0.0)
    return lift_rmse_mm(squares, steps * drawn.reference.shape[1])


def lift_rmse_mm(squares: Array, frames: Array) -> Array:
    """Return the RMSE [mm] of sums of squared height differences [m2] over ``frames`` frames."""
    return np.asarray(1000 * np.sqrt(squares / frames))


def _step(
    drawn: Lifts, period: float, state: LiftState, actions: jax.Array
) -> tuple[LiftState, jax.Array, jax.Array]:
    state, frames = lifting.control_step(state, drawn.body, lifting.due(drawn, state.step), actions)
    noise = lifting.due(drawn, state.step).noise
    return state, lifting.observe(state, noise, drawn.latency, period), frames.squares()


def play_pairs(lifts: Sequence[tuple[Scenario, int]]) -> Array:
    """Return the RMSE [mm] of each lift (n,) of the human-human team, in the twin.

    The second person is :class:`.SecondPerson`, unchanged: it gets the observations of the task.
    """
    drawn = draw_lifts(lifts)
    body, far_body = drawn.body, partner_body(len(lifts))
    person = HUMANS["human"].person
    delays = round(person.visual_delay / FRAME), round(person.haptic_delay / FRAME)
    partners = [SecondPerson(subject=person) for _ in lifts]
    for partner in partners:
        partner.reset(policy_seed())
    size, steps = drawn.reference.shape[1], np.asarray(drawn.steps)

    @jax.jit
    def step(
        pair: pair_plant.PairPlant, correction: jax.Array, now: Due, far: jax.Array
    ) -> tuple[pair_plant.PairPlant, jax.Array, Frames]:
        wanted, references = lifting.references(correction, pair.heights, body, now)

        def move(state: pair_plant.PairPlant, first: int, last: int) -> pair_plant.PairPlant:
            mine, others = references[first:last], far[first:last]
            return pair_plant.advance_pair(state, body, far_body, mine, others)

        pair, frames = in_chunks(pair, size, move)
        return pair, wanted, frames

    pair, correction = pair_plant.pair_at_rest(len(lifts)), jnp.zeros(len(lifts))
    squares, far = np.zeros(len(lifts)), np.zeros((size, len(lifts)))
    for number in range(drawn.longest()):
        views = _partner_views(pair, delays, size, number)
        for index in np.flatnonzero(number < steps):
            far[:, index] = within_range(partners[index].act(views[index]).tolist())
        now = lifting.due(drawn, jnp.asarray(number))
        pair, correction, frames = step(pair, correction, now, jnp.asarray(far, jnp.float32))
        squares += np.where(number < steps, np.asarray(frames.squares(), np.float64), 0.0)
    return lift_rmse_mm(squares, steps * size)


def _partner_views(
    pair: pair_plant.PairPlant, delays: tuple[int, int], size: int, step: int
) -> Array:
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
