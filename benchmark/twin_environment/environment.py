"""The environment: lifts of the twin as pure functions of keys, states and actions."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.actions import action_limit
from colift.agents.agent import FRAME
from colift.benchmark.environment.state import TrueState
from colift.benchmark.episode.reward_unit import UNIT
from colift.benchmark.tasks.running_score import square_at_end
from colift.benchmark.twin.learning_person import SENSES, added_in_step, person_senses
from colift.benchmark.twin.lifts import Lifts, Share
from colift.benchmark.twin.task_twin import TaskTwin
from colift.benchmark.twin.view import LiftState
from colift.benchmark.twin_environment.pool import LiftPool
from colift.benchmark.twin_environment.running import (
    Running,
    nothing_missed,
    square_so_far,
    with_step,
)
from colift.benchmark.twin_environment.spaces import Box
from colift.benchmark.world.table import WEIGHT_SHARE

ROBOT: Final = "robot"
HUMAN: Final = "human"

ADDED: Final = 2
"""Numbers of a learning person's action: of the height, and of the pitch of the wrists."""

KNOWN: Final = 100.0
"""Bound of a learning person's observation, whose numbers are of the order of 1."""


class State(NamedTuple):
    """The state of an environment."""

    lift: LiftState
    added: jax.Array
    """(2,) what a learning person adds at the end of the last step, at most 1."""
    running: Running
    """What was missed so far."""
    lane: jax.Array
    """Number of the lift in the pool."""


class Played(NamedTuple):
    """A step of an environment, before it begins anew."""

    state: State
    reward: jax.Array
    terminated: jax.Array
    """Whether the table was dropped, or the lift lost."""
    truncated: jax.Array
    """Whether the lift is over."""
    score_mm: jax.Array
    """The score of a lift that has ended [mm]; else 0."""


class TwinEnv:
    r"""Lifts of the twin, in the conventions of JaxMARL.

    ``jit``, ``scan``, ``vmap``, and gradients through ``vmap`` work. An episode that has ended
    begins anew in the same step, with a lift that the step's key draws.

    The reward is the share of a step in the score: the sum over the K steps of an episode is

    .. math:: -K \; \text{score}^2 \; [\text{cm}^2],

    with a drop and an unfinished plan counted as in the score. All agents have the same reward. A
    place that has to be held (a hurdle of ``agree``) costs its square distance as soon as the table
    comes near, and is refunded as the table comes nearer.

    ``infos["score_mm"]`` is the score of an episode that has just ended, else 0.

    Parameters
    ----------
    twin
        The rules.
    pool
        The lifts.
    learns
        Whether the person learns, too: an agent ``"human"``, who adds to what the person of the
        task does. Its action is the addition to the height of the hands (1 is 2 cm) and to the
        pitch of the wrists (1 is 0.1 rad).
    box
        The class of the spaces, for wrappers that check it.
    single
        Whether gradients of single steps are wanted: ``jax.grad(step)``. Many lifts then take
        several times as long.
    """

    def __init__(
        self,
        twin: TaskTwin,
        pool: LiftPool,
        *,
        learns: bool = False,
        box: Callable[..., Any] = Box,
        single: bool = False,
    ) -> None:
        self.twin, self.pool, self.learns = twin, pool, learns
        self.name = f"colift-{twin.task.name}"
        self.agents = [ROBOT, HUMAN] if learns else [ROBOT]
        self.num_agents = len(self.agents)
        self.max_steps = pool.longest
        low, high = (bound.astype(np.float32) for bound in twin.task.robot_bounds())
        limit = action_limit(pool.frames * FRAME)
        self.observation_spaces = {ROBOT: box(low, high, low.shape)}
        self.action_spaces = {ROBOT: box(-limit, limit, (1,))}
        if learns:
            self.observation_spaces[HUMAN] = box(-KNOWN, KNOWN, (SENSES + self._known(),))
            self.action_spaces[HUMAN] = box(-1.0, 1.0, (ADDED,))
        self._core = self._alone if single else self._batched()

    def observation_space(self, agent: str) -> Any:
        """Return the space of an agent's observations."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Any:
        """Return the space of an agent's actions; a robot's is clipped to it."""
        return self.action_spaces[agent]

    @property
    def agent_classes(self) -> dict[str, list[str]]:
        """The agents by class."""
        return {agent: [agent] for agent in self.agents}

    @partial(jax.jit, static_argnums=0)
    def reset(self, key: jax.Array) -> tuple[dict[str, jax.Array], State]:
        """Return the agents' observations and the state of a lift that the key draws."""
        lane = jax.random.randint(key, (1,), 0, self.pool.size)
        state, lifts = self.begun(lane), self.pool.lifts(lane)
        views = self.views(state, lifts, self.share(state))
        found: tuple[dict[str, jax.Array], State] = jax.tree.map(
            lambda each: each[..., 0], (views, state)
        )
        return found

    @partial(jax.jit, static_argnums=0)
    def step(
        self, key: jax.Array, state: State, actions: dict[str, jax.Array], reset_state: Any = None
    ) -> tuple[dict[str, jax.Array], State, dict[str, Any], dict[str, Any], dict[str, Any]]:
        """Return observations, state, rewards, ends and information after a step.

        Parameters
        ----------
        key
            Draws the lift that follows if this one ends.
        state
            The state.
        actions
            Of each agent.
        reset_state
            Ignored: the states of JaxMARL's loops.
        """
        fresh = jax.random.randint(key, (), 0, self.pool.size)
        robot = jnp.reshape(actions[ROBOT], ())
        human = jnp.reshape(actions[HUMAN], (ADDED,)) if self.learns else jnp.zeros(ADDED)
        views, state, reward, done, score = self._core(fresh, state, robot, human)
        return (
            views,
            state,
            dict.fromkeys(self.agents, reward),
            dict.fromkeys([*self.agents, "__all__"], done),
            {"score_mm": jnp.full(self.num_agents, score)},
        )

    @partial(jax.jit, static_argnums=0)
    def true_state(self, state: State) -> jax.Array:
        """Return the numbers of :class:`.TrueState` (9,), for critics: no agent sees them."""
        many = jax.tree.map(lambda each: each[..., jnp.newaxis], state)
        lifts, plant = self.pool.lifts(many.lane), many.lift.plant
        moving, near = plant.moving, plant.heights[0]
        frame = jnp.maximum(many.lift.step * lifts.frames - 1, 0)
        found = {
            TrueState.HUMAN_END: near,
            TrueState.ROBOT_END: near + plant.differences[0],
            TrueState.HUMAN_VELOCITY: moving.velocity,
            TrueState.ROBOT_VELOCITY: moving.far_velocity,
            TrueState.HAND_HEIGHT: plant.hand,
            TrueState.HAND_COMMAND: many.lift.command,
            TrueState.HUMAN_FORCE: plant.forces[0] + WEIGHT_SHARE * lifts.body.load,
            TrueState.ROBOT_FORCE: moving.far_force,
            TrueState.TARGET: lifts.drawn.target.at(frame),
        }
        return jnp.stack([found[each][0] for each in TrueState])

    # n lifts at a time, the last axis of each array

    def begun(self, lane: jax.Array) -> State:
        """Return lifts of the pool (n,) before their first step."""
        lifts, count = self.pool.lifts(lane), len(lane)
        lift = self.twin.at_rest(lifts)._replace(step=jnp.zeros(count, jnp.int32))
        state = State(lift, jnp.zeros((ADDED, count)), nothing_missed(self.twin, count), lane)
        # Of the types that later states have, so that a step is compiled once.
        typed: State = jax.tree.map(
            lambda each: jax.lax.convert_element_type(each, each.dtype), state
        )
        return typed

    def share(self, state: State) -> Share:
        """Return the noise of the coming step."""
        return self.pool.share(state.lane, state.lift.step)

    def views(self, state: State, lifts: Lifts, share: Share) -> dict[str, jax.Array]:
        """Return the agents' observations (k, n)."""
        views = {ROBOT: self.twin.observe(state.lift, lifts, share)}
        if self.learns:
            senses = person_senses(state.lift.plant, lifts.body)
            known = self.twin.known(state.lift, lifts, share)
            views[HUMAN] = jnp.concatenate((senses, known))
        return views

    def advance(self, state: State, robot: jax.Array, human: jax.Array) -> Played:
        """Return n lifts after a step.

        Parameters
        ----------
        state
            The lifts.
        robot
            (n,) changes of the hand command [m].
        human
            (2, n) additions of learning people.
        """
        twin, begun, lifts = self.twin, state.lift, self.pool.lifts(state.lane)
        human = jnp.clip(human, -1.0, 1.0)
        added = added_in_step(state.added, human, lifts.frames) if self.learns else None
        lift, ends = twin.step(begun, lifts, self.share(state), robot, added)
        running = with_step(twin, state.running, twin.squares(begun, lifts, ends))
        terminated = twin.dropped(lift, lifts)
        left = jnp.maximum(lifts.steps - lift.step, 0)
        over = left == 0
        played = lift.step * lifts.frames
        missing = jnp.maximum(left * lifts.frames, twin.unfinished(lift, lifts))
        error = twin.error(lifts, running.gathered, played)
        whole = square_at_end(error, played, missing)
        done = terminated | over
        square = jnp.where(done, whole, square_so_far(twin, running, lifts))
        before = square_so_far(twin, state.running, lifts)
        return Played(
            state=State(lift, human, running, state.lane),
            reward=(before - square) * lifts.steps / UNIT,
            terminated=terminated,
            truncated=over & ~terminated,
            score_mm=jnp.where(done, 1000 * jnp.sqrt(jnp.maximum(whole, 0.0)), 0.0),
        )

    def renewed(self, state: State, ended: jax.Array, fresh: jax.Array) -> State:
        """Return lifts, of which those that have ended begin anew as ``fresh`` ones (n,)."""
        chosen: State = jax.tree.map(
            lambda new, old: jnp.where(ended, new, old), self.begun(fresh), state
        )
        return chosen

    def _many(self, fresh: jax.Array, state: State, robot: jax.Array, human: jax.Array) -> Any:
        """Return observations, states, rewards, ends and scores [mm] of n lifts after a step."""
        played = self.advance(state, robot, human)
        done = played.terminated | played.truncated
        after = self.renewed(played.state, done, fresh)
        views = self.views(after, self.pool.lifts(after.lane), self.share(after))
        return views, after, played.reward, done, played.score_mm

    def _alone(self, *one: Any) -> Any:
        """Return the same of one lift."""
        many = jax.tree.map(lambda each: jnp.asarray(each)[..., jnp.newaxis], one)
        return jax.tree.map(lambda each: each[..., 0], self._many(*many))

    def _batched(self) -> Callable[..., Any]:
        """Return the step of one lift, which under ``vmap`` is that of many with the axis last."""
        core = jax.custom_batching.custom_vmap(self._alone)

        @core.def_vmap
        def _(count: int, batched: Sequence[Any], *one: Any) -> Any:
            def last(value: jax.Array, has: bool) -> jax.Array:
                if has:
                    return jnp.moveaxis(value, 0, -1)
                return jnp.broadcast_to(value[..., jnp.newaxis], (*value.shape, count))

            found = self._many(*jax.tree.map(last, one, tuple(batched)))
            found = jax.tree.map(lambda each: jnp.moveaxis(each, -1, 0), found)
            return found, jax.tree.map(lambda _: True, found)

        return core

    def _known(self) -> int:
        """Return how many numbers people know about the task."""
        lane = jnp.zeros(1, jnp.int32)
        state = self.begun(lane)
        return len(self.twin.known(state.lift, self.pool.lifts(lane), self.share(state)))
