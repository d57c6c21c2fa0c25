"""Whole lifts of the twin with a policy at the robot's end, as one function."""

from collections.abc import Callable
from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME, RobotObservation
from colift.agents.control.recurrent import GatedNetwork, Memory, act
from colift.benchmark.twin import playing as lifting
from colift.benchmark.twin.arm import ArmVariation
from colift.benchmark.twin.lifts import Lifts
from colift.benchmark.twin.playing import LiftState


class JaxFunctions:
    """The array functions of networks in JAX, for many lifts at a time."""

    def product(self, matrix: jax.Array, vector: jax.Array) -> jax.Array:
        """Return a matrix (m, k) times vectors as columns (k, n)."""
        return matrix @ vector

    def tanh(self, values: jax.Array) -> jax.Array:
        """Return the hyperbolic tangent of each value."""
        return jnp.tanh(values)

    def stack(self, values: Any) -> jax.Array:
        """Return arrays stacked along a new first axis."""
        return jnp.stack(values)

    def join(self, values: Any) -> jax.Array:
        """Return arrays joined along the first axis."""
        return jnp.concatenate(values)


JAX: Final = JaxFunctions()


class Sensing(NamedTuple):
    """Variation of the sensors of n lifts relative to the benchmark's."""

    lost: jax.Array
    """(s, n) 1 where a sample is lost and the last one is seen again, else 0."""
    own: jax.Array
    """(s, 2, n) error of the observed height and command of the robot's hand [m]."""


class Outcome(NamedTuple):
    """Figures of n lifts."""

    rmse_mm: jax.Array
    """(n,) RMSE of the table's ends [mm]."""
    bend_mm: jax.Array
    """(n,) root mean square of the second differences of the command [mm]."""
    force_n: jax.Array
    """(n,) root mean square force of the human's hands, beyond the share of the weight [N]."""


Policy = Callable[[Any, jax.Array], tuple[Any, jax.Array]]
"""Returns memory and actions (n,) [m] for a memory and observations (k, n) of its task."""


def recurrent(network: GatedNetwork, count: int) -> tuple[Policy, Memory]:
    """Return the policy of a network, and its memory at the beginning of n lifts."""

    def policy(memory: Memory, view: jax.Array) -> tuple[Memory, jax.Array]:
        return act(network, memory, view, JAX)

    zero = jnp.zeros(count)
    return policy, Memory(jnp.zeros((network.units, count)), zero, zero, zero, zero)


def rollout(
    policy: Policy,
    memory: Any,
    lifts: Lifts,
    variation: ArmVariation | None = None,
    sensing: Sensing | None = None,
) -> Outcome:
    """Return the outcome of lifts with a policy; differentiable in all arguments.

    Parameters
    ----------
    policy, memory
        The policy, and its memory at the beginning.
    lifts
        People, plans and noise.
    variation, sensing
        Variation of arms and sensors; None is the benchmark's.
    """
    size, period = lifts.reference.shape[1], lifts.reference.shape[1] * FRAME
    count, longest = lifts.size, lifts.longest()
    differs = sensing or Sensing(jnp.zeros((longest, count)), jnp.zeros((longest, 2, count)))

    def step(
        state: tuple[LiftState, Any, jax.Array], now: tuple[lifting.Due, Sensing]
    ) -> tuple[tuple[LiftState, Any, jax.Array], tuple[jax.Array, jax.Array, jax.Array]]:
        playing, memory, last = state
        share, differs = now
        view = lifting.observe(playing, share.noise, lifts.latency, period)
        seen = view[: RobotObservation.HAND_HEIGHT]
        seen = jnp.where((differs.lost > 0) & (playing.step > 0), last, seen)
        own = view[RobotObservation.HAND_HEIGHT : RobotObservation.TIME] + differs.own
        view = jnp.concatenate((seen, own, view[RobotObservation.TIME :]))
        memory, action = policy(memory, view)
        valid = (playing.step < lifts.steps).astype(jnp.float32)
        before = playing.command
        playing, frames = lifting.control_step(playing, lifts.body, share, action, variation)
        return (playing, memory, seen), (
            frames.squares() * valid,
            (playing.plant.forces[:size] ** 2).mean(axis=0) * valid,
            (playing.command - before) * valid,
        )

    start = (lifting.at_rest(lifts.size), memory, jnp.zeros((2, count)))
    shares = lifting.Due(lifts.reference, lifts.seen_target, lifts.noise)
    _, (squares, forces, changes) = jax.lax.scan(jax.checkpoint(step), start, (shares, differs))
    frames = lifts.steps * size
    bends = (jnp.diff(changes, axis=0) ** 2).sum(axis=0) / lifts.steps
    return Outcome(
        rmse_mm=1000 * jnp.sqrt(squares.sum(axis=0) / frames + 1e-12),
        bend_mm=1000 * jnp.sqrt(bends + 1e-12),
        force_n=jnp.sqrt(forces.sum(axis=0) / lifts.steps + 1e-12),
    )
