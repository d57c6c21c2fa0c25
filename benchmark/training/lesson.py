"""A lesson: the lifts and the loss from which a network learns by gradients, and its policy."""

from collections.abc import Mapping
from types import ModuleType
from typing import Any, NamedTuple, Protocol

import jax
import numpy as np
from colift.agents.control.recurrent import GatedNetwork
from colift.benchmark.training.apg_settings import ApgSettings
from numpy.typing import NDArray

Weights = Mapping[str, NDArray[Any]]


class BatchDraw(NamedTuple):
    """The draw of a batch."""

    size: int
    """Lifts of the batch."""
    key: jax.Array
    varied: jax.Array
    """Variation of the arms."""


class GradientLesson(Protocol):
    """The lifts and the loss of which gradients are taken."""

    def __hash__(self) -> int: ...

    def first(self, settings: ApgSettings, seed: int) -> Any:
        """Return the network, or the networks, to begin with."""

    def draw(self, settings: ApgSettings) -> Any:
        """Return the lifts to learn from, as arrays."""

    def loss(
        self, network: Any, pool: Any, settings: ApgSettings, draw: BatchDraw
    ) -> tuple[jax.Array, jax.Array]:
        """Return the loss [mm] and the mean RMSE [mm] of a batch.

        Parameters
        ----------
        network
            The policy's network.
        pool
            The drawn lifts.
        settings
            Of the training.
        draw
            Draw of the batch.
        """


class PolicyLesson(GradientLesson, Protocol):
    """A lesson whose result is a policy: one file of weights, and its description."""

    @property
    def package(self) -> ModuleType:
        """The package of the trained policy's ``policy.py``."""

    def steps(self, pool: Any) -> float:
        """Return the mean number of control steps of these lifts."""

    def validation(self) -> Any:
        """Return the lifts of a curve, as arrays, with people who are not used for learning."""

    def errors(self, network: Any, lifts: Any) -> jax.Array:
        """Return the policy's RMSE in the lifts of a curve [mm]."""

    def check(self, weights: Weights) -> object:
        """Raise an InputError if the policy could not use these weights."""

    def weights(self, network: GatedNetwork) -> Weights:
        """Return the arrays of the policy's file of weights."""

    def about(self, settings: ApgSettings) -> dict[str, str]:
        """Return the entries of the manifest that say what was trained, and on what."""


def first_network(inputs: int, units: int, seed: int, outputs: int = 1) -> GatedNetwork:
    """Return a network to begin with: small random weights, with a small output."""
    rng = np.random.default_rng(seed)

    def weights(rows: int, columns: int) -> jax.Array:
        drawn = rng.standard_normal((rows, columns)) / np.sqrt(columns)
        return jax.numpy.asarray(drawn, jax.numpy.float32)

    return GatedNetwork(
        inputs=weights(3 * units, inputs),
        memory=weights(3 * units, units),
        bias=jax.numpy.zeros(3 * units),
        output=0.1 * weights(outputs, units + inputs),
        output_bias=jax.numpy.zeros(outputs),
    )
