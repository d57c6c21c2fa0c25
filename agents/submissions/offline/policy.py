"""A trained network of the last observations.

The file is complete with ``weights.npz`` beside it: NumPy is all that it needs.
"""

from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path

import numpy as np
from colift.agents.agent import RobotObservation

HERE = Path(__file__).parent

LIMIT = 0.04  # Largest change of the hand command in a step [m].
STEPS = 15  # Steps of the human's motion among the inputs: 1.5 s.
COMMANDS = 3  # Steps of the hand command among the inputs.
INPUTS = 4 + COMMANDS + STEPS


class Window:
    """The inputs: heights relative to the human's end, and changes in the last steps [m].

    ======= ====================================================================
    0       height of the human's end
    1       hand command above it
    2       hand above the hand command
    3       robot's end above the human's end
    4 to 6  changes of the hand command in the last three steps, newest first
    7 to 21 changes of the human's end in the last fifteen steps, newest first
    ======= ====================================================================
    """

    def reset(self) -> None:
        """Begin a lift: before it, everything stood still."""
        self._seen: list[float] = []
        self._commands: list[float] = []

    def __call__(self, observation: np.ndarray) -> np.ndarray:
        """Return the inputs (22,) after one more observation."""
        human, end, hand, command = map(float, observation[: RobotObservation.TIME])
        seen = [human, *(self._seen or [human] * STEPS)]
        commands = [command, *(self._commands or [command] * COMMANDS)]
        self._seen, self._commands = seen[:STEPS], commands[:COMMANDS]
        now = [human, command - human, hand - command, end - human]
        pairs = (*pairwise(commands), *pairwise(seen))
        return np.array([*now, *(newer - older for newer, older in pairs)])


class Network:
    """A perceptron of tanh units; its output, too, is a tanh, times the largest change.

    Parameters
    ----------
    weights
        ``centre`` and ``deviation`` of the inputs, (22,); ``w0``, ``b0``, ``w1``, ``b1`` and so on,
        of shapes (outputs, inputs) and (outputs,), the last with one output.
    """

    def __init__(self, weights: Mapping[str, np.ndarray]) -> None:
        known = {name: np.asarray(weights[name], dtype=np.float64) for name in weights}
        depth = (len(known) - 2) // 2
        names = {f"{kind}{i}" for i in range(depth) for kind in "wb"}
        if depth < 1 or {*names, "centre", "deviation"} != known.keys():
            raise ValueError(f"weights must be centre, deviation, w0, b0, ..., got {sorted(known)}")
        self.centre, self.deviation = known["centre"], known["deviation"]
        if not self.centre.shape == self.deviation.shape == (INPUTS,):
            raise ValueError(f"centre and deviation must be ({INPUTS},)")
        self.layers = [(known[f"w{i}"], known[f"b{i}"]) for i in range(depth)]
        size = INPUTS
        for i, (weight, bias) in enumerate(self.layers):
            outputs = 1 if i == depth - 1 else bias.size
            if weight.shape != (outputs, size) or bias.shape != (outputs,):
                wanted = f"w{i} must be ({outputs}, {size}) and b{i} ({outputs},)"
                raise ValueError(f"{wanted}, got {weight.shape} and {bias.shape}")
            size = outputs
        broken = [name for name, value in known.items() if not np.isfinite(value).all()]
        if broken:
            raise ValueError(f"weights must be finite, {broken[0]} has other numbers")

    def __call__(self, inputs: np.ndarray) -> float:
        """Return the change of the hand command [m]."""
        x = (inputs - self.centre) / self.deviation
        for weight, bias in self.layers:
            x = np.tanh(weight @ x + bias)
        return LIMIT * float(x[0])


class Policy:
    """Moves the hands as the network says, from what it saw in the last second and a half."""

    def __init__(self, network: Network | None = None) -> None:
        if network is None:
            with np.load(HERE / "weights.npz") as stored:
                network = Network(stored)
        self._network = network
        self._window = Window()

    def reset(self, seed: int) -> None:
        """Begin a lift."""
        self._window.reset()

    def act(self, observation: np.ndarray) -> np.ndarray:
        """Return the change of the hands' height [m]."""
        return np.array([self._network(self._window(observation))])
