"""Behaviour cloning: the actions of a data set, fitted by least squares. Needs JAX: import it late.

    minimise  mean (pi(s) - a)^2 over the steps (s, a) of the data,

with the inputs s of :class:`.Window`, the history of a second and a half, and a tanh at the end of
the network pi (D. Pomerleau, "ALVINN: an autonomous land vehicle in a neural network", NIPS 1988).
"""

from typing import Any

import jax
import jax.numpy as jnp
import optax
from colift.benchmark.training.offline_data import OfflineData
from colift.benchmark.training.offline_run import Learning
from colift.benchmark.training.offline_settings import CloneSettings
from colift.benchmark.training.perceptron import Layers, forward, new_layers


def learning(settings: CloneSettings, data: OfflineData, seed: int) -> Learning:
    """Return the training, to be run by :func:`.offline_run.train_offline`.

    Parameters
    ----------
    settings, data
        Settings and data of the training.
    seed
        Seed of the first weights.
    """
    sizes = (data.inputs.shape[1], *settings.hidden, 1)
    actor = new_layers(jax.random.key(seed), sizes)
    optimiser = optax.adam(optax.cosine_decay_schedule(settings.rate, settings.updates))

    def loss(actor: Layers, inputs: jax.Array, actions: jax.Array) -> jax.Array:
        """Return the mean square of the policy's deviation from the data."""
        return jnp.mean((jnp.tanh(forward(actor, inputs)) - actions) ** 2)

    def update(
        state: tuple[Layers, Any], arrays: tuple[jax.Array, ...], key: jax.Array
    ) -> tuple[Layers, Any]:
        actor, memory = state
        chosen = jax.random.randint(key, (settings.batch,), 0, data.steps)
        slope = jax.grad(loss)(actor, *(each[chosen] for each in arrays))
        changes, memory = optimiser.update(slope, memory)
        return optax.apply_updates(actor, changes), memory

    return Learning(
        start=(actor, optimiser.init(actor)),
        arrays=(jnp.asarray(data.inputs), jnp.asarray(data.actions)),
        update=update,
        actor=lambda state: state[0],
        about=f"Behaviour cloning of {data.name}: a network of {settings.hidden} units.",
    )
