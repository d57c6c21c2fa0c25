"""The lessons of tasks with touch: the score of the task, on lifts of its twin."""

from types import ModuleType
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.control.recurrent import GatedNetwork
from colift.agents.submissions import touch as submission
from colift.agents.tasks.touch.alone_law import law_of, ports_of
from colift.agents.tasks.touch.touch_controller import touch_network
from colift.agents.tasks.touch.touch_law import (
    TouchMemory,
    TouchNetwork,
    touch_at_rest,
)
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.training.apg_settings import ApgSettings, task_by_rules
from colift.benchmark.training.lesson import BatchDraw, Weights, first_network
from colift.benchmark.training.pool import draw_arms
from colift.benchmark.training.validation import LEARNING_SEEDS, VALIDATION_SEEDS, learning_seeds
from colift.benchmark.twin.drawing import draw_lift, draw_lifts, stack
from colift.benchmark.twin.lifts import Lifts, shares, some
from colift.benchmark.twin.people import with_new_manners
from colift.benchmark.twin.policy import JAX
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin


class TouchLesson:
    """The lesson of a task with touch: the loss of a batch is its mean RMSE.

    Parameters
    ----------
    task
        Name of the task.
    alone
        Whether the network is blind to its partner; see :class:`.TouchNetwork`.
    """

    package: ModuleType = submission

    def __init__(self, task: str, *, alone: bool = False) -> None:
        made = task_by_rules(task)
        self.task, self.alone, self.twin = task, alone, TaskTwin(made, made.person)

    def first(self, settings: ApgSettings, seed: int) -> Any:
        """Return a network that hardly departs from level."""
        inputs, outputs = ports_of(self.twin.task.senses, alone=self.alone)
        return first_network(inputs, settings.units, seed, outputs)

    def draw(self, settings: ApgSettings) -> Any:
        """Return lifts with drawn people, the behaviours in turn."""
        seeds = learning_seeds(settings.lifts)
        return stack([draw_lift(self.scenario(seed), seed) for seed in seeds])

    def scenario(self, seed: int) -> Scenario:
        """Return the lift of a seed."""
        behaviours = self.twin.task.behaviours
        behaviour = behaviours[seed % len(behaviours)]
        return make_scenario(behaviour, f"draw-{seed}", task=self.task)

    def steps(self, pool: Any) -> float:
        """Return the mean number of control steps of these lifts."""
        return float(pool.steps.mean())

    def loss(
        self, network: Any, pool: Any, settings: ApgSettings, draw: BatchDraw
    ) -> tuple[jax.Array, jax.Array]:
        """Return the loss [mm], which is the mean RMSE, and the mean RMSE [mm] of a batch."""
        mean = self.errors(network, self.batch(pool, settings, draw)).mean()
        return mean, mean

    def batch(self, pool: Lifts, settings: ApgSettings, draw: BatchDraw) -> Lifts:
        """Return some of the lifts, with people and arms drawn anew."""
        keys = jax.random.split(draw.key, 4)
        lifts = some(pool, jax.random.randint(keys[0], (draw.size,), 0, pool.size))
        lifts = lifts._replace(arms=draw_arms(draw.varied, draw.size, keys[2:]))
        return with_new_manners(self.twin.person, lifts, keys[1], settings.wide)

    def policy(self, network: Any, count: int) -> tuple[Any, TouchMemory]:
        """Return the policy of a network, and its memory at the beginning of n lifts."""
        learned = TouchNetwork(self.task, self.twin.task.senses, network, self.alone)
        return touch_policy(learned, count)

    def known(self) -> int:
        """Return how many numbers people know about the task."""
        seed = LEARNING_SEEDS[0]
        lifts = stack([draw_lift(self.scenario(seed), seed)])
        first = jax.tree.map(lambda each: each[0], shares(lifts))
        return len(self.twin.known(self.twin.at_rest(lifts), lifts, first))

    def validation(self) -> Lifts:
        """Return the lifts of a curve, with people who are not used for learning."""
        return draw_lifts([(self.scenario(seed), seed) for seed in VALIDATION_SEEDS])

    def errors(self, network: Any, lifts: Lifts) -> jax.Array:
        """Return the policy's RMSE in lifts (n,) [mm]."""
        policy, memory = self.policy(network, lifts.size)
        return rollout(self.twin, policy, memory, lifts).rmse_mm

    def check(self, weights: Weights) -> TouchNetwork:
        """Return the network in NumPy, in double precision."""
        return touch_network(weights, "trained weights")

    def weights(self, network: GatedNetwork) -> Weights:
        """Return the arrays of the policy's file of weights."""
        arrays = {name: np.asarray(array) for name, array in network._asdict().items()}
        scales = [(sense.scale, sense.rate) for sense in self.twin.task.senses]
        known = {"alone": np.array(True)} if self.alone else {}
        rows = np.array(scales).reshape(-1, 2)
        return {**arrays, "task": np.array(self.task), "scales": rows, **known}

    def about(self, settings: ApgSettings) -> dict[str, str]:
        """Return the entries of the manifest that say what was trained, and on what."""
        return {
            "description": f"A table that is held by touch, with a departure from level by "
            f"{settings.units} gated recurrent units, trained by gradients through the "
            f"twin of {self.task!r}.",
            "trained_on": f"{settings.lifts} lifts of the task {self.task!r} of colift with drawn "
            f"people, seeds {LEARNING_SEEDS[0]} to {LEARNING_SEEDS[settings.lifts - 1]}.",
        }


def touch_policy(learned: TouchNetwork, count: int) -> tuple[Any, TouchMemory]:
    """Return the policy of a network, and its memory at the beginning of n lifts."""
    law = law_of(learned)

    def policy(memory: TouchMemory, view: jax.Array) -> tuple[TouchMemory, jax.Array]:
        return law(learned, memory, view, JAX)

    rest = touch_at_rest(learned)
    return policy, jax.tree.map(lambda zero: jnp.zeros((*np.shape(zero), count)), rest)
