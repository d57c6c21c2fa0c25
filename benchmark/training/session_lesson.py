"""The lesson of sessions: ten lifts in a row with the same person.

The loss of a batch is the mean RMSE of all lifts. A network may keep its units from lift to lift,
or begin each lift anew; or it is told the person's habits, as no policy is.
"""

from dataclasses import replace
from types import ModuleType
from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.agent import RobotObservation
from colift.agents.control.recurrent import GatedNetwork, Memory, network_of
from colift.agents.humans.serial import Serial
from colift.agents.sessions.session_controller import SESSION_INPUTS, act_in_session, next_lift
from colift.agents.submissions import session as submission
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.suites.catalogue import make_subject
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.session.telling import TOLD, habits_told
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.lesson import BatchDraw, Weights, first_network
from colift.benchmark.training.sensing import with_own_errors
from colift.benchmark.training.session_kinds import Kind
from colift.benchmark.training.validation import VALIDATION_SEEDS, learning_seeds
from colift.benchmark.twin.lifts import Lifts
from colift.benchmark.twin.policy import JAX, Policy
from colift.benchmark.twin.sessions import SessionOutcome, draw_sessions, play_sessions
from colift.benchmark.twin.task_twin import TaskTwin

OWN: Final = len(RobotObservation)
"""Numbers of a policy's own observation."""

LONGEST_MEMORY: Final = 600.0
"""Time constants of half of the units of a network that remembers are at first uniform up to this
[steps]; those of the others are 2 steps (C. Tallec and Y. Ollivier, "Can recurrent neural networks
warp time?", ICLR 2018)."""


class SessionPool(NamedTuple):
    """Drawn sessions, and what a network is told in them."""

    lifts: Lifts
    """With a first axis of k places."""
    told: jax.Array
    """(k, m, n) the habits."""


class SessionLesson:
    """The lesson of a suite of sessions, with other people.

    Parameters
    ----------
    suite
        The suite, of one behaviour.
    kind
        See :data:`Kind`.
    """

    package: ModuleType = submission

    def __init__(self, suite: Suite, kind: Kind) -> None:
        self.kind, self._made, self._seeds = kind, suite.scenarios[0], suite.seeds
        self.twin = TaskTwin.of(suite.scenarios[:1])

    def first(self, settings: ApgSettings, seed: int) -> GatedNetwork:
        """Return a network that hardly corrects the line."""
        told = TOLD if self.kind == "told" else 0
        network = first_network(SESSION_INPUTS + told, settings.units, seed)
        if self.kind != "remember":
            return network
        rng, units = np.random.default_rng((seed, 1)), settings.units
        constants = rng.uniform(2.0, LONGEST_MEMORY, units)
        constants[: units // 2] = 2.0
        bias = np.concatenate((np.zeros(units), np.log(constants - 1.0), np.zeros(units)))
        return network._replace(bias=jnp.asarray(bias, jnp.float32))

    def scenario(self, person: int) -> Scenario:
        """Return the session of a person."""
        return replace(self._made, subject=make_subject(f"draw-{person}"))

    def sessions(self, people: range) -> SessionPool:
        """Return the sessions of some people."""
        drawn = [(self.scenario(each), self._seeds) for each in people]
        told = [
            [habits_told(scenario.subject, place) for scenario, _ in drawn]
            for place in range(len(self._seeds))
        ]
        return SessionPool(
            draw_sessions(drawn), jnp.asarray(np.swapaxes(np.array(told), 1, 2), jnp.float32)
        )

    def draw(self, settings: ApgSettings) -> SessionPool:
        """Return sessions to learn from: as many lifts as the settings say."""
        return self.sessions(self._people(settings))

    def _people(self, settings: ApgSettings) -> range:
        return learning_seeds(settings.lifts // len(self._seeds))

    def steps(self, pool: SessionPool) -> float:
        """Return the mean number of control steps of a session."""
        return float(pool.lifts.steps.sum(axis=0).mean())

    def play(self, network: GatedNetwork, pool: SessionPool) -> SessionOutcome:
        """Return the outcome of sessions with a network."""
        lifts, count = pool.lifts, pool.lifts.steps.shape[-1]
        told = pool.told if self.kind == "told" else pool.told[:, :0]
        each_step = jnp.repeat(told[:, jnp.newaxis], lifts.gain.shape[1], axis=1)
        policy, memory = session_policy(network, count)
        return play_sessions(self.twin, policy, memory, self._between, lifts, each_step)

    def _between(self, memory: Memory) -> Memory:
        kept = next_lift(memory)
        return kept if self.kind == "remember" else kept._replace(units=0.0 * kept.units)

    def loss(
        self, network: GatedNetwork, pool: SessionPool, settings: ApgSettings, draw: BatchDraw
    ) -> tuple[jax.Array, jax.Array]:
        """Return the loss [mm], which is the mean RMSE, and the mean RMSE [mm] of a batch."""
        chosen_key, errors_key = jax.random.split(draw.key)
        chosen = jax.random.randint(chosen_key, (draw.size,), 0, pool.lifts.steps.shape[-1])
        some: Any = jax.tree.map(lambda array: array[..., chosen], pool)
        keys = jax.random.split(errors_key, len(self._seeds))

        def noisy(lifts: Lifts, key: jax.Array) -> Lifts:
            return with_own_errors(lifts, settings.encoders, key)

        batch = some._replace(lifts=jax.vmap(noisy)(some.lifts, keys))
        mean = self.play(network, batch).rmse_mm.mean()
        return mean, mean

    def validation(self) -> SessionPool:
        """Return the sessions of a curve, with people who are not used for learning."""
        return self.sessions(VALIDATION_SEEDS)

    def errors(self, network: GatedNetwork, lifts: SessionPool) -> jax.Array:
        """Return the RMSE in the lifts that count (k, n) [mm]."""
        human = self._made.human
        assert isinstance(human, Serial), human
        return self.play(network, lifts).rmse_mm[-human.counted :]

    def check(self, weights: Weights) -> GatedNetwork:
        """Return the network in NumPy, in double precision."""
        return network_of(weights, "trained weights", SESSION_INPUTS)

    def weights(self, network: GatedNetwork) -> Weights:
        """Return the arrays of the policy's file of weights."""
        return {name: np.asarray(array) for name, array in network._asdict().items()}

    def about(self, settings: ApgSettings) -> dict[str, str]:
        """Return the entries of the manifest that say what was trained, and on what."""
        people = self._people(settings)
        remembers = self.kind == "remember"
        return {
            "description": "A straight line through the human's last heights, corrected by "
            f"{settings.units} gated recurrent units that "
            f"{'remember' if remembers else 'forget'} the lifts of a session, trained by gradients "
            "through the twin.",
            "trained_on": f"Sessions of colift with {len(people)} drawn people, draw-{people[0]} "
            f"to draw-{people[-1]}.",
            "parameters": f"remember={'true' if remembers else 'false'}",
        }


def session_policy(network: GatedNetwork, count: int) -> tuple[Policy, Memory]:
    """Return the policy of a network, and its memory at the beginning of n sessions."""

    def policy(memory: Memory, view: jax.Array) -> tuple[Memory, jax.Array]:
        return act_in_session(network, memory, view[:OWN], JAX, (view[OWN:],))

    zero = jnp.zeros(count)
    return policy, Memory(jnp.zeros((network.units, count)), zero, zero, zero, zero)
