"""Implicit Q-learning, offline reinforcement learning without unseen actions. Needs JAX.

A value V and action values Q1, Q2 are learned from the actions of the data alone, V as an
expectile: nearly the best value that the robots of the data reached in a state. The policy pi is a
clone in which better actions have more weight. With u = min_i Qi'(s, a) - V(s) and slow copies Qi'
of Qi,

    V   minimises  |tau - [u < 0]| u^2,
    Qi  minimises  (r + gamma (1 - ended) V(s') - Qi(s, a))^2,
    pi  minimises  exp(beta u / mean |u|) (pi(s) - a)^2.

I. Kostrikov, A. Nair, S. Levine, "Offline reinforcement learning with implicit Q-learning", ICLR
2022. Three things are adapted: rewards are in centimetres, advantages are relative to their mean
size, so that beta has the same meaning in every set, and gamma looks a third of a second ahead,
when the effect of a command has ended.
"""

from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
import optax
from colift.benchmark.training.offline_data import OfflineData
from colift.benchmark.training.offline_run import Learning
from colift.benchmark.training.offline_settings import IqlSettings
from colift.benchmark.training.perceptron import Layers, forward, new_layers

CENTIMETRES: Final = 100.0
"""Scale of the rewards [1/m], which are then of the order of one."""

LARGEST_WEIGHT: Final = 20.0
"""Bound of an action's weight."""


class Networks(NamedTuple):
    """All that is learned."""

    actor: Layers
    value: Layers
    critics: tuple[Layers, Layers]


class State(NamedTuple):
    """All that changes in the training."""

    networks: Networks
    slow: tuple[Layers, Layers]
    memory: Any


def worth(critic: Layers, inputs: jax.Array, actions: jax.Array) -> jax.Array:
    """Return the values (n,) of actions."""
    return forward(critic, jnp.concatenate((inputs, actions), axis=1))[:, 0]


def learning(settings: IqlSettings, data: OfflineData, seed: int) -> Learning:
    """Return the training, to be run by :func:`.offline_run.train_offline`.

    Parameters
    ----------
    settings, data
        Settings and data of the training.
    seed
        Seed of the first weights.
    """
    size, hidden = data.inputs.shape[1], settings.hidden
    own = jax.random.split(jax.random.key(seed), 4)
    networks = Networks(
        actor=new_layers(own[0], (size, *hidden, 1)),
        value=new_layers(own[1], (size, *hidden, 1)),
        critics=(
            new_layers(own[2], (size + 1, *hidden, 1)),
            new_layers(own[3], (size + 1, *hidden, 1)),
        ),
    )
    optimiser = optax.adam(optax.cosine_decay_schedule(settings.rate, settings.updates))

    def loss(networks: Networks, slow: tuple[Layers, Layers], *rows: jax.Array) -> jax.Array:
        """Return the sum of the three losses; none has a gradient in the networks of another."""
        seen, done, rewards, coming, ended = rows
        value = forward(networks.value, seen)[:, 0]
        advantage = jnp.minimum(*(worth(each, seen, done) for each in slow)) - value
        side = jnp.where(advantage < 0, 1 - settings.expectile, settings.expectile)
        value_loss = jnp.mean(side * advantage**2)

        after = jax.lax.stop_gradient(forward(networks.value, coming)[:, 0])
        target = CENTIMETRES * rewards + settings.gamma * (1 - ended) * after
        first, second = (worth(each, seen, done) - target for each in networks.critics)
        critic_loss = jnp.mean(first**2) + jnp.mean(second**2)

        relative = jax.lax.stop_gradient(advantage / jnp.mean(jnp.abs(advantage)))
        weight = jnp.minimum(jnp.exp(settings.beta * relative), LARGEST_WEIGHT)
        miss = jnp.tanh(forward(networks.actor, seen)) - done
        return value_loss + critic_loss + jnp.mean(weight * miss[:, 0] ** 2)

    def update(state: State, arrays: tuple[jax.Array, ...], key: jax.Array) -> State:
        chosen = jax.random.randint(key, (settings.batch,), 0, data.steps)
        rows = (each[chosen] for each in arrays)
        slope = jax.grad(loss)(state.networks, state.slow, *rows)
        changes, memory = optimiser.update(slope, state.memory)
        networks = optax.apply_updates(state.networks, changes)
        slow = optax.incremental_update(networks.critics, state.slow, settings.slow)
        return State(networks, slow, memory)

    parts = (data.inputs, data.actions, data.rewards, data.coming, data.ended)
    return Learning(
        start=State(networks, networks.critics, optimiser.init(networks)),
        arrays=tuple(map(jnp.asarray, parts)),
        update=update,
        actor=lambda state: state.networks.actor,
        about=f"Implicit Q-learning from {data.name}: a network of {hidden} units.",
    )
