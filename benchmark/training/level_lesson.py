"""The lesson of a level table.

The loss of a batch is the mean over its lifts of

    weight (RMSE + smoothness bend + gentleness force),

the score [mm], the root mean square of the second differences of the command [mm], and that of the
force at the human's hands beyond half of the table's weight [N].
The weight is 1 except for people with wide habits (:mod:`.pool`), whose force does not count: a
robot that learns to be gentle with people whom it cannot predict follows late.
"""

from functools import partial
from types import ModuleType

import jax
import numpy as np
from colift.agents.control.recurrent import INPUTS, GatedNetwork, network_of
from colift.agents.control.recurrent_controller import RecurrentController
from colift.agents.submissions import recurrent as submission
from colift.benchmark.training.anticipation import FIRST_SEED
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.lesson import BatchDraw, Weights, first_network
from colift.benchmark.training.pool import LearningBatch, Pool, draw_batch, draw_pool
from colift.benchmark.training.validation import validation_error
from colift.benchmark.twin.rollout import recurrent, rollout


class LevelLesson:
    """The lesson of the task ``level``."""

    package: ModuleType = submission

    def first(self, settings: ApgSettings, seed: int) -> GatedNetwork:
        """Return a network that hardly corrects the line."""
        return first_network(INPUTS, settings.units, seed)

    def draw(self, settings: ApgSettings) -> Pool:
        """Return lifts with people of the benchmark's population, and of wide habits."""
        return draw_pool(settings.lifts, settings.wide, settings.unsettled)

    def steps(self, pool: Pool) -> float:
        """Return the mean number of control steps of these lifts."""
        return float(pool.lifts.steps.mean())

    def loss(
        self, network: GatedNetwork, pool: Pool, settings: ApgSettings, draw: BatchDraw
    ) -> tuple[jax.Array, jax.Array]:
        """Return the loss [mm] and the mean RMSE [mm] of a batch."""
        batch = draw_batch(pool, settings, draw)
        return batch_loss(network, batch, settings.smoothness, settings.gentleness)

    def error(self, weights: Weights) -> float:
        """Return the policy's mean RMSE on validation lifts in the engine [mm]."""
        return validation_error(partial(RecurrentController, self.check(weights)))

    def check(self, weights: Weights) -> GatedNetwork:
        """Return the network in NumPy, in double precision."""
        return network_of(weights, "trained weights")

    def weights(self, network: GatedNetwork) -> Weights:
        """Return the arrays of the policy's file of weights."""
        return {name: np.asarray(array) for name, array in network._asdict().items()}

    def about(self, settings: ApgSettings) -> tuple[str, str]:
        """Return the manifest's ``description`` and ``trained_on``."""
        return (
            f"A straight line through the human's last heights, corrected by "
            f"{settings.units} gated recurrent units, trained by gradients through the twin.",
            f"{settings.lifts} lifts of colift with drawn people, seeds {FIRST_SEED} to "
            f"{FIRST_SEED + settings.lifts - 1}, {settings.wide:.0%} of them with wide habits.",
        )


def batch_loss(
    network: GatedNetwork, batch: LearningBatch, smoothness: float, gentleness: float
) -> tuple[jax.Array, jax.Array]:
    """Return the loss [mm] and the mean RMSE [mm] of a batch."""
    policy, memory = recurrent(network, batch.lifts.size)
    found = rollout(policy, memory, batch.lifts, batch.variation, batch.sensing)
    force = batch.common * found.force_n
    cost = found.rmse_mm + smoothness * found.bend_mm + gentleness * force
    return (batch.weight * cost).mean(), found.rmse_mm.mean()
