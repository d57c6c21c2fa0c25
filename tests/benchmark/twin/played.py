"""Policies of the twins as agents of the engine."""

import contextlib

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
