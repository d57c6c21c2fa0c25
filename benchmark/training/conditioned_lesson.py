"""The lesson of a suite with conditions: lifts as in the suite, with other people.

The behaviours that are for tests alone (:class:`.Unseen`) are left out.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.agent import RobotObservation
from colift.agents.control.recurrent import INPUTS, GatedNetwork, Memory, act
from colift.agents.humans import Subject
from colift.base.errors import InputError
from colift.benchmark.episode.conditions import Conditions
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.robust.telling import Telling, is_conditioned
from colift.benchmark.tasks.robust.unseen import Unseen
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.lesson import BatchDraw, first_network
from colift.benchmark.training.sensing import with_own_errors
from colift.benchmark.training.validation import learning_seeds
from colift.benchmark.twin.drawing import DrawnLift, draw_lift, stack
from colift.benchmark.twin.lifts import Lifts, some
from colift.benchmark.twin.policy import JAX, Policy
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin

LONGEST: Final = 12.0
"""Time after which a lift is cut off [s]."""

OWN: Final = len(RobotObservation)
"""Numbers of a policy's own observation."""


class ConditionedPool(NamedTuple):
    """Drawn lifts, and what a network is told in them."""

    lifts: Lifts
    told: jax.Array
    """(s, k, n)"""


class ConditionedLesson:
    """The lesson of a suite with conditions; the loss is the mean RMSE.

    Parameters
    ----------
    suite
        The suite.

    Raises
    ------
    InputError
        If it has scenarios of another task or without conditions, or different conditions.
    """

    def __init__(self, suite: Suite) -> None:
        known = [each for each in suite.scenarios if is_conditioned(each)]
        found = {each.conditions for each in suite.scenarios}
        if len(known) < len(suite.scenarios) or len(found) != 1:
            raise InputError(
                f"{suite.name} must have a level table in all lifts, and the same conditions"
            )
        (conditions,) = found
        assert conditions is not None
        self.conditions: Conditions = conditions
        self._scenarios = {
            each.behaviour: each for each in known if not isinstance(each.human, Unseen)
        }
        if not self._scenarios:
            raise InputError(f"all behaviours of {suite.name} are for tests alone")
        self.telling = Telling(behaviours=tuple(self._scenarios))
        self.twin = TaskTwin.of(list(self._scenarios.values()))

    def first(self, settings: ApgSettings, seed: int) -> GatedNetwork:
        """Return a network that hardly corrects the line."""
        return first_network(INPUTS + self.telling.size, settings.units, seed)

    def scenario(self, seed: int, conditions: Conditions) -> Scenario:
        """Return the lift of a seed, with a person of training."""
        behaviours = list(self._scenarios.values())
        made = behaviours[seed % len(behaviours)]
        return replace(made, subject=Subject.draw(seed), conditions=conditions)

    def draw(self, settings: ApgSettings) -> ConditionedPool:
        """Return lifts in which a network is told nothing."""
        nothing = replace(self.telling, sensor=False, person=False)
        return told_pool(self.lifts(settings, self.conditions), nothing)

    def lifts(self, settings: ApgSettings, conditions: Conditions) -> list[DrawnLift]:
        """Return lifts to learn from, with the suite's conditions or others."""
        seeds = learning_seeds(settings.lifts)
        rules = self.twin.person
        return [draw_lift(self.scenario(each, conditions), each, rules, LONGEST) for each in seeds]

    def loss(
        self, network: GatedNetwork, pool: ConditionedPool, settings: ApgSettings, draw: BatchDraw
    ) -> tuple[jax.Array, jax.Array]:
        """Return the loss [mm], which is the mean RMSE, and the mean RMSE [mm] of a batch."""
        keys = jax.random.split(draw.key, 2)
        chosen = jax.random.randint(keys[0], (draw.size,), 0, pool.lifts.size)
        lifts, told = some(pool.lifts, chosen), pool.told[..., chosen]
        policy, memory = told_policy(network, draw.size)
        lifts = with_own_errors(lifts, settings.encoders, keys[1])
        mean = rollout(self.twin, policy, memory, lifts, told=told).rmse_mm.mean()
        return mean, mean


def told_pool(drawn: Sequence[DrawnLift], telling: Telling) -> ConditionedPool:
    """Return drawn lifts as arrays, with what a network is told in them."""
    lifts = stack(drawn)
    told = np.zeros((len(lifts.gain), telling.size, len(drawn)), np.float32)
    for index, each in enumerate(drawn):
        assert each.conditions is not None
        # As many as the lift has steps, which may be cut off.
        numbers = telling.numbers(each.scenario, each.conditions)[: len(each.ages)]
        told[: len(numbers), :, index] = numbers
    return ConditionedPool(lifts, jnp.asarray(told))


def told_policy(network: GatedNetwork, count: int) -> tuple[Policy, Memory]:
    """Return the policy of a network that is told more, and its memory in n lifts."""

    def policy(memory: Memory, view: jax.Array) -> tuple[Memory, jax.Array]:
        return act(network, memory, view[:OWN], JAX, view[OWN:])

    zero = jnp.zeros(count)
    return policy, Memory(jnp.zeros((network.units, count)), zero, zero, zero, zero)
