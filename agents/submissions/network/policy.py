"""A trained network that corrects a straight line through the heights of the human's end.

The file is complete with ``weights.npz`` beside it: NumPy is all that it needs.
"""

from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path

import numpy as np
from colift.agents.agent import RobotObservation

HERE = Path(__file__).parent

FIXED = 7  # Inputs beside the history.
NEAR, FAR = 0.02, 0.1  # Scales of differences and of heights [m].
LEAD = 2.0  # Control periods from a sample to the end of the action that answers it.
CORRECTION = 0.03  # Largest correction of the line [m].


class Senses:
    """The inputs: heights relative to the human's end, and its changes in the last steps.

    ====== ==================================================================
    0      height of the human's end [m]
    1      hand command above it [m]
    2      hand above the hand command [m]
    3      robot's end above the human's end [m]
    4 to 6 changes of the hand command in the last three steps, newest first [m]
    7 on   changes of the human's end in the last steps, newest first [m]
    ====== ==================================================================
    """

    def __init__(self, steps: int) -> None:
        self.steps = steps
        self.reset()

    def reset(self) -> None:
        """Begin a lift: before it, everything stood still."""
        self._seen: list[float] = []
        self._commands = [0.0] * 3

    def __call__(self, observation: np.ndarray) -> np.ndarray:
        """Return the inputs (7 + steps,) after one more observation."""
        human, end, hand, command = map(float, observation[: RobotObservation.TIME])
        if not self._seen:
            self._seen = [human] * self.steps
            self._commands = [command] * 3
        seen, commands = [human, *self._seen], [command, *self._commands]
        self._seen, self._commands = seen[:-1], commands[:-1]
        now = [human, command - human, hand - command, end - human]
        pairs = (*pairwise(commands), *pairwise(seen))
        return np.array([*now, *(newer - older for newer, older in pairs)])


def scales(steps: int) -> np.ndarray:
    """Return the fixed scale of each input [m]."""
    return np.array([FAR, *[NEAR] * (FIXED - 1 + steps)])


def line(senses: np.ndarray) -> float:
    """Return the change of the hand command [m] that holds the human's last pace."""
    return float(LEAD * senses[FIXED] - senses[1])


class Network:
    """A perceptron of tanh units with a linear path beside it.

    Parameters
    ----------
    weights
        ``w0``, ``b0``, ``w1``, ``b1`` and so on, of shapes (outputs, inputs) and (outputs,), the
        last with one output; and ``linear`` (inputs,).
    """

    def __init__(self, weights: Mapping[str, np.ndarray]) -> None:
        known = {name: np.asarray(weights[name], dtype=np.float64) for name in weights}
        depth = (len(known) - 1) // 2
        names = [f"{kind}{i}" for i in range(depth) for kind in "wb"]
        if depth < 1 or {*names, "linear"} != known.keys():
            raise ValueError(f"weights must be w0, b0, w1, b1, ... and linear, got {sorted(known)}")
        self.linear = known["linear"]
        self.layers = [(known[f"w{i}"], known[f"b{i}"]) for i in range(depth)]
        size = self.linear.size
        if size <= FIXED:
            raise ValueError(f"linear must have more than {FIXED} weights, got {size}")
        for i, (weight, bias) in enumerate(self.layers):
            outputs = 1 if i == depth - 1 else bias.size
            if weight.shape != (outputs, size) or bias.shape != (outputs,):
                wanted = f"w{i} must be ({outputs}, {size}) and b{i} ({outputs},)"
                raise ValueError(f"{wanted}, got {weight.shape} and {bias.shape}")
            size = outputs
        broken = [name for name, value in known.items() if not np.isfinite(value).all()]
        if broken:
            raise ValueError(f"weights must be finite, {broken[0]} has other numbers")
        self.steps = self.linear.size - FIXED
        self._scales = scales(self.steps)

    def correction(self, senses: np.ndarray) -> float:
        """Return the correction of the line [m]."""
        inputs = x = senses / self._scales
        for weight, bias in self.layers[:-1]:
            x = np.tanh(weight @ x + bias)
        weight, bias = self.layers[-1]
        return CORRECTION * float(np.tanh(weight @ x + bias + self.linear @ inputs)[0])


class Policy:
    """Holds the human's last pace, corrected by a network."""

    def __init__(self, network: Network | None = None) -> None:
        if network is None:
            with np.load(HERE / "weights.npz") as stored:
                network = Network(stored)
        self.network = network
        self.senses = Senses(network.steps)

    def reset(self, seed: int) -> None:
        """Begin a lift."""
        self.senses.reset()

    def act(self, observation: np.ndarray) -> np.ndarray:
        """Return the change of the hands' height [m]."""
        senses = self.senses(observation)
        return np.array([line(senses) + self.network.correction(senses)])
