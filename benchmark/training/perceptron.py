"""Perceptrons in JAX, and their weights for NumPy. Needs JAX: import it late."""

from collections.abc import Sequence
from itertools import pairwise

import jax
import jax.numpy as jnp
import numpy as np
from numpy.typing import NDArray

Layers = list[tuple[jax.Array, jax.Array]]
"""Weight (outputs, inputs) and bias (outputs,) of each layer."""


def new_layers(key: jax.Array, sizes: Sequence[int]) -> Layers:
    """Return drawn layers: weights of variance 1 / inputs, those of the last a hundredth of that.

    Parameters
    ----------
    key
        JAX's random key.
    sizes
        Units of the input, of each hidden layer, and of the output.
    """
    layers = []
    for i, (inputs, outputs) in enumerate(pairwise(sizes)):
        key, own = jax.random.split(key)
        size = (0.1 if i == len(sizes) - 2 else 1.0) / np.sqrt(inputs)
        layers.append((size * jax.random.normal(own, (outputs, inputs)), jnp.zeros(outputs)))
    return layers


def forward(layers: Layers, x: jax.Array) -> jax.Array:
    """Return the outputs (n, outputs) of tanh layers with a linear last one, for inputs (n, k)."""
    for weight, bias in layers[:-1]:
        x = jnp.tanh(x @ weight.T + bias)
    weight, bias = layers[-1]
    return x @ weight.T + bias


def numpy_layers(layers: Layers) -> dict[str, NDArray[np.float64]]:
    """Return the layers as ``w0``, ``b0``, ``w1`` and so on."""
    return {
        f"{kind}{i}": np.asarray(value, dtype=np.float64)
        for i, layer in enumerate(layers)
        for kind, value in zip("wb", layer, strict=True)
    }
