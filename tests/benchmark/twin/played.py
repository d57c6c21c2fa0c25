"""Policies of the twins as agents of the engine."""

import contextlib

import jax
import jax.numpy as jnp
import numpy as np
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode


class Played:
    """A policy of the twin as an agent of the engine."""

    def __init__(self, policy):
        self.policy = policy

    def reset(self, seed):
        self.memory = 0.0

    def act(self, observation):
        self.memory, action = self.policy(self.memory, observation)
        return np.array([action])


def engine_scores(make, lifts):
    """Return the scores of the lifts with new agents."""
    scores = []
    for scenario, seed in lifts:
        with contextlib.closing(Lift(scenario)) as lift:
            scores.append(run_episode(lift, make(), seed).scores)
    return scores


def agents_in_twin(twin, make, lifts):
    """Return the errors of the lifts with agents as they play in the engine, step by step."""
    agents = [make() for _ in range(lifts.size)]
    for agent in agents:
        agent.reset(0)
    state, missed = twin.at_rest(lifts.size), []
    view, step, missing = map(jax.jit, (twin.observe, twin.step, twin.missed))
    for number in range(len(lifts.gain)):
        noise = jax.tree.map(lambda each, number=number: each[number], twin.noise(lifts))
        seen = np.asarray(view(state, lifts, noise), np.float64)
        acts = [float(agent.act(seen[:, i])[0]) for i, agent in enumerate(agents)]
        after, ends = step(state, lifts, noise, jnp.asarray(acts))
        missed.append(missing(state, after, lifts, ends))
        state = after
    return np.asarray(twin.score_mm(lifts, jax.tree.map(lambda *all: jnp.stack(all), *missed)))
