"""Guided Q-learning of a levelling controller (eq. 1, Algorithm 1)."""

import json
import math
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np
from numpy.typing import NDArray

ACTIONS = (2, 1, 0, -1, -2)
"""Direction and magnitude of a movement, in position steps (section IV.A)."""


@dataclass(frozen=True, kw_only=True)
class QParameters:
    """Parameters of the learner; the first three are the paper's (section IV.A)."""

    learning_rate: float = 0.9
    """alpha of eq. 1."""
    discount: float = 0.2
    """gamma of eq. 1."""
    position_step: float = 0.02
    """One step of the hand [m], "the smallest precise movement"."""
    edges: tuple[float, ...] = (-0.03, -0.01, 0.01, 0.03)
    """Inner edges of the states [m] in the height difference, human minus robot. The paper draws
    equal bins without numbers; these put 0, one and two position steps in the middle of theirs."""

    @property
    def states(self) -> int:
        """Number of states."""
        return len(self.edges) + 1


Q_PARAMETERS = QParameters()


def state_of(difference: float, parameters: QParameters = Q_PARAMETERS) -> int:
    """Return the state of a height difference, human minus robot [m]; 0 is the lowest.

    A difference on an edge belongs to the state below it.

    Raises
    ------
    ValueError
        If the difference is not a number, which would otherwise count as the highest.
    """
    if math.isnan(difference):
        raise ValueError(f"a height difference must be a number, got {difference}")
    return int(np.searchsorted(parameters.edges, difference))


def right_action(state: int, parameters: QParameters = Q_PARAMETERS) -> int:
    """Return the index of the action that levels the table best from the middle of a state.

    Valid for as many states as actions, each one position step wide, centred on level.
    """
    steps = state - parameters.states // 2
    return ACTIONS.index(steps)


class QLearner:
    """Q-table and visit counts of Algorithm 1.

    Parameters
    ----------
    seed
        Seed for breaking ties; the paper does not specify how.
    """

    def __init__(self, seed: int, parameters: QParameters = Q_PARAMETERS) -> None:
        self._parameters = parameters
        self._rng = np.random.default_rng(seed)
        shape = (parameters.states, len(ACTIONS))
        self.table: NDArray[np.float64] = np.zeros(shape)
        self.visits: NDArray[np.int64] = np.zeros(shape, dtype=np.int64)

    def select(self, state: int) -> int:
        """Return the index of the action that was visited least (line 6) and count the visit."""
        counts = self.visits[state]
        action = int(self._rng.choice(np.flatnonzero(counts == counts.min())))
        self.visits[state, action] += 1
        return action

    def update(self, state: int, action: int, reward: float, following: int) -> None:
        """Update the table by one experience (eq. 1).

        dQ(s, a) = alpha (r + gamma max_a' Q(s', a') - Q(s, a))
        """
        aim = reward + self._parameters.discount * self.table[following].max()
        self.table[state, action] += self._parameters.learning_rate * (
            aim - self.table[state, action]
        )

    @property
    def right(self) -> bool:
        """Whether the greedy action is the right one, and the only greedy one, in every state."""
        best = self.table.max(axis=1)
        for state, row in enumerate(self.table):
            greedy = np.flatnonzero(row == best[state])
            if greedy.tolist() != [right_action(state, self._parameters)]:
                return False
        return True


@cache
def learned_table() -> NDArray[np.float64]:
    """Return the shipped Q-table, as ``colift learn reactive`` learned it; states x actions."""
    text = files(__package__).joinpath("data", "reactive.json").read_text()
    table = np.array(json.loads(text)["table"])
    table.flags.writeable = False
    return table
