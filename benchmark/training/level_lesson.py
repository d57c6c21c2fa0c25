"""The lesson of a level table.

The loss of a batch is the mean over its lifts of

    weight (RMSE + smoothness bend + gentleness force),

the score [mm], the root mean square of the second differences of the command [mm], and that of the
force at the human's hands beyond half of the table's weight [N].
The weight is 1 except for people with wide habits (:mod:`.pool`), whose force does not count: a
robot that learns to be gentle with people whom it cannot predict follows late.
"""

from types import ModuleType

import jax
import numpy as np
from colift.agents.control.recurrent import INPUTS, GatedNetwork, network_of
from colift.agents.submissions import recurrent as submission
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.training.anticipation import FIRST_SEED
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.data import Timing, scenario
from colift.benchmark.training.lesson import BatchDraw, Weights, first_network
from colift.benchmark.training.pool import TWIN, LearningBatch, Pool, draw_batch, draw_pool
from colift.benchmark.training.validation import VALIDATION_SEEDS
from colift.benchmark.twin.drawing import draw_lifts
from colift.benchmark.twin.lifts import Lifts
from colift.benchmark.twin.policy import recurrent
from colift.benchmark.twin.rollout import rollout


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

    def validation(self) -> Lifts:
        """Return the lifts of a curve, with people who are not used for learning."""
        return draw_lifts(
            [(scenario(seed, BEHAVIOURS, Timing()), seed) for seed in VALIDATION_SEEDS]
        )

    def errors(self, network: GatedNetwork, lifts: Lifts) -> jax.Array:
        """Return the policy's RMSE in lifts (n,) [mm]."""
        policy, memory = recurrent(network, lifts.size)
        return rollout(TWIN, policy, memory, lifts).rmse_mm

    def check(self, weights: Weights) -> GatedNetwork:
        """Return the network in NumPy, in double precision."""
        return network_of(weights, "trained weights")

    def weights(self, network: GatedNetwork) -> Weights:
        """Return the arrays of the policy's file of weights."""
        return {name: np.asarray(array) for name, array in network._asdict().items()}

    def about(self, settings: ApgSettings) -> dict[str, str]:
        """Return the entries of the manifest that say what was trained, and on what."""
        return {
            "description": f"A straight line through the human's last heights, corrected by "
            f"{settings.units} gated recurrent units, trained by gradients through the twin.",
            "trained_on": f"{settings.lifts} lifts of colift with drawn people, seeds "
            f"{FIRST_SEED} to {FIRST_SEED + settings.lifts - 1}, "
            f"{settings.wide:.0%} of them with wide habits.",
        }


def batch_loss(
    network: GatedNetwork, batch: LearningBatch, smoothness: float, gentleness: float
) -> tuple[jax.Array, jax.Array]:
    """Return the loss [mm] and the mean RMSE [mm] of a batch."""
    policy, memory = recurrent(network, batch.lifts.size)
    found = rollout(TWIN, policy, memory, batch.lifts)
    force = batch.common * found.force_n
    cost = found.rmse_mm + smoothness * found.bend_mm + gentleness * force
    return (batch.weight * cost).mean(), found.rmse_mm.mean()
