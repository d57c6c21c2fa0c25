"""Analytic policy gradients: a recurrent policy by gradients through whole lifts of the twin.

The loss of a batch is the mean over its lifts of

    RMSE + smoothness * bend,

both in millimetres: the score, and the root mean square of the second differences of the command.
Nothing is estimated: the gradient is that of the lifts themselves (compare J. Freeman et al.,
"Brax", NeurIPS 2021, on short-horizon actor-critic and analytic gradients).
"""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
import optax

from ...agents.control.recurrent import INPUTS, Network
from ...agents.errors import InputError
from ..twin.rollout import rollout
from .pool import Batch, Pool, draw_batch, draw_pool

PARTS: Final = 2
"""Parts of a batch, each in a thread of its own: a fixed number, so that sums keep their order."""

LARGEST_GRADIENT: Final = 5.0
"""Norm to which gradients are cut."""


@dataclass(frozen=True, kw_only=True)
class ApgParameters:
    """Parameters of the training.

    Raises
    ------
    InputError
        If a number is out of range.
    """

    updates: int = 800
    """Steps of the optimiser."""
    lifts: int = 4000
    """Lifts that batches are drawn from."""
    batch: int = 256
    """Lifts of an update."""
    units: int = 64
    """Gated recurrent units."""
    rate: float = 3e-3
    """Learning rate at its highest; it rises for 5 % of the updates, then falls as a cosine."""
    wide: float = 0.2
    """Share of lifts with people, bodies and sensors from wide ranges."""
    varied: float = 0.3
    """Variation of the arms."""
    smoothness: float = 0.05
    """Cost of bends, relative to the RMSE."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        for name in ("updates", "units"):
            if getattr(self, name) < 1:
                raise InputError(f"--{name} must be at least 1, got {getattr(self, name)}")
        if self.batch < PARTS or self.batch % PARTS:
            raise InputError(f"--batch must be a multiple of {PARTS}, got {self.batch}")
        if not 0 <= self.wide < 1:
            raise InputError(f"--wide must be at least 0 and below 1, got {self.wide}")
        for name in ("varied", "smoothness"):
            if not 0 <= getattr(self, name) < np.inf:
                raise InputError(f"--{name} must be at least 0, got {getattr(self, name)}")
        if not 0 < self.rate < 1:
            raise InputError(f"--rate must be between 0 and 1, got {self.rate}")


class Learner(NamedTuple):
    """All that changes during the training."""

    network: Network
    optimiser: Any
    update: int
    """Updates done."""


class Update(NamedTuple):
    """A step of the training."""

    learner: Learner
    rmse_mm: float
    """Mean RMSE of the batch's lifts in the twin [mm]."""


def first_network(units: int, seed: int) -> Network:
    """Return the network to begin with: small random weights, and no correction of the line."""
    rng = np.random.default_rng(seed)

    def weights(rows: int, columns: int) -> jax.Array:
        drawn = rng.standard_normal((rows, columns)) / np.sqrt(columns)
        return jnp.asarray(drawn, jnp.float32)

    return Network(
        inputs=weights(3 * units, INPUTS),
        memory=weights(3 * units, units),
        bias=jnp.zeros(3 * units),
        output=0.1 * weights(1, units + INPUTS),
        output_bias=jnp.zeros(1),
    )


def optimiser(parameters: ApgParameters) -> optax.GradientTransformation:
    """Return Adam with its schedule and the cut of the gradients."""
    warm = max(parameters.updates // 20, 1)
    schedule = optax.warmup_cosine_decay_schedule(
        0.1 * parameters.rate, parameters.rate, warm, max(parameters.updates, warm + 1)
    )
    return optax.chain(optax.clip_by_global_norm(LARGEST_GRADIENT), optax.adam(schedule))


def begin(parameters: ApgParameters, seed: int) -> Learner:
    """Return the learner before the first update."""
    network = first_network(parameters.units, seed)
    return Learner(network, optimiser(parameters).init(network), 0)


def loss(network: Network, batch: Batch, smoothness: float) -> tuple[jax.Array, jax.Array]:
    """Return the loss [mm] and the mean RMSE [mm] of a batch."""
    found = rollout(network, batch.lifts, batch.variation, batch.sensing)
    rmse = found.rmse_mm.mean()
    return rmse + smoothness * found.bend_mm.mean(), rmse


def train(
    parameters: ApgParameters, seed: int, learner: Learner | None = None, pool: Pool | None = None
) -> Iterator[Update]:
    """Yield the learner after each update; the same seed gives the same weights.

    Parameters
    ----------
    parameters
        Of the training.
    seed
        Of the first weights and of the batches; the lifts are the same for all.
    learner
        Where to go on; none: from the beginning.
    pool
        The drawn lifts; none: draw them.
    """
    learner = learner or begin(parameters, seed)
    lifts = pool or draw_pool(parameters.lifts, parameters.wide)
    descent = optimiser(parameters)
    size = parameters.batch // PARTS

    @jax.jit
    def gradient(network: Network, lifts: Pool, key: jax.Array) -> tuple[Any, Network]:
        batch = draw_batch(lifts, size, parameters.wide, parameters.varied, key)
        of_batch = partial(loss, batch=batch, smoothness=parameters.smoothness)
        return jax.value_and_grad(of_batch, has_aux=True)(network)

    @jax.jit
    def descend(
        network: Network, state: Any, parts: list[tuple[Any, Network]]
    ) -> tuple[Network, Any, jax.Array]:
        total = jax.tree.map(lambda *each: sum(each) / PARTS, *(part for _, part in parts))
        steps, state = descent.update(total, state, network)
        rmse = sum(rmse for (_, rmse), _ in parts) / PARTS
        return optax.apply_updates(network, steps), state, rmse

    network, state = learner.network, learner.optimiser
    with ThreadPoolExecutor(PARTS) as threads:
        for update in range(learner.update, parameters.updates):
            key = jax.random.fold_in(jax.random.key(seed), update)
            keys = [jax.random.fold_in(key, part) for part in range(PARTS)]
            parts = list(threads.map(partial(_finished, gradient, network, lifts), keys))
            network, state, rmse = descend(network, state, parts)
            yield Update(Learner(network, state, update + 1), float(rmse))


def _finished(function: Any, *arguments: Any) -> Any:
    """Return what a function of JAX returns, once it has been computed."""
    return jax.block_until_ready(function(*arguments))
