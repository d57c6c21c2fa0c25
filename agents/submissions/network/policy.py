"""A trained network that corrects a straight line through the heights of the human's end.

The file is complete with ``weights.npz`` beside it: NumPy is all that it needs.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from colift.agents.agent import RobotObservation

HERE = Path(__file__).parent

FIXED = 7  # Inputs beside the history.
NEAR, FAR = 0.02, 0.1  # Scales of differences and of heights [m].
COMMAND = RobotObservation.HAND_COMMAND
LEAD = 2.0  # Control periods from a sample to the end of the action that answers it.
CORRECTION = 0.03  # Largest correction of the line [m], unless the weights say another.


class Past(NamedTuple):
    """What is remembered of a lift, newest first."""

    seen: Any
    """(steps,) heights of the human's end [m]."""
    commands: Any
    """(3,) hand commands [m]."""


def past_before(observation: Any, steps: int, arrays: Any = np) -> Past:
    """Return the past before the first observation of a lift: everything stood still."""
    seen, command = observation[RobotObservation.HUMAN_END], observation[COMMAND]
    return Past(arrays.full(steps, seen), arrays.full(3, command))


def sensed(past: Past, observation: Any, arrays: Any = np) -> tuple[Past, Any]:
    """Return the past and the inputs after one more observation; ``arrays`` is NumPy, or alike.

    ====== ==================================================================
    0      height of the human's end [m]
    1      hand command above it [m]
    2      hand above the hand command [m]
    3      robot's end above the human's end [m]
    4 to 6 changes of the hand command in the last three steps, newest first [m]
    7 on   changes of the human's end in the last steps, newest first [m]
    last   what else the task's robots observe, in a task with touch
    ====== ==================================================================
    """
    human, end, hand, command = observation[: RobotObservation.TIME]
    seen = arrays.concatenate((observation[:1], past.seen))
    commands = arrays.concatenate((observation[COMMAND : COMMAND + 1], past.commands))
    now = arrays.stack((human, command - human, hand - command, end - human))
    more = observation[len(RobotObservation) :]
    parts = (now, commands[:-1] - commands[1:], seen[:-1] - seen[1:], more)
    return Past(seen[:-1], commands[:-1]), arrays.concatenate(parts)


class Senses:
    """The inputs of a lift, observation by observation; see :func:`sensed`."""

    def __init__(self, steps: int) -> None:
        self.steps = steps
        self.reset()

    def reset(self) -> None:
        """Begin a lift: before it, everything stood still."""
        self._past: Past | None = None

    def __call__(self, observation: np.ndarray) -> np.ndarray:
        """Return the inputs after one more observation."""
        past = self._past or past_before(observation, self.steps)
        self._past, inputs = sensed(past, observation)
        return np.asarray(inputs)


def scales(steps: int) -> np.ndarray:
    """Return the fixed scale of each input of a level table [m]."""
    return np.array([FAR, *[NEAR] * (FIXED - 1 + steps)])


def line(senses: Any) -> Any:
    """Return the change of the hand command [m] that holds the human's last pace."""
    return LEAD * senses[FIXED] - senses[1]


class Network:
    """A perceptron of tanh units with a linear path beside it.

    Parameters
    ----------
    weights
        ``w0``, ``b0``, ``w1``, ``b1`` and so on, of shapes (outputs, inputs) and (outputs,), the
        last with one output; and ``linear`` (inputs,). In a task with touch also ``more``, the
        scales of what else it observes, and ``reach`` (1,), the largest correction [m].
    """

    def __init__(self, weights: Mapping[str, np.ndarray]) -> None:
        known = {name: np.asarray(weights[name], dtype=np.float64) for name in weights}
        more, reach = known.pop("more", np.zeros(0)), known.pop("reach", np.array([CORRECTION]))
        depth = (len(known) - 1) // 2
        names = [f"{kind}{i}" for i in range(depth) for kind in "wb"]
        if depth < 1 or {*names, "linear"} != known.keys():
            raise ValueError(f"weights must be w0, b0, w1, b1, ... and linear, got {sorted(known)}")
        self.linear = known["linear"]
        self.layers = [(known[f"w{i}"], known[f"b{i}"]) for i in range(depth)]
        size = self.linear.size
        fixed = FIXED + more.size
        if size <= fixed:
            raise ValueError(f"linear must have more than {fixed} weights, got {size}")
        if more.shape != (more.size,) or reach.shape != (1,):
            raise ValueError(f"more must be (n,) and reach (1,), got {more.shape}, {reach.shape}")
        known |= {"more": more, "reach": reach}
        for i, (weight, bias) in enumerate(self.layers):
            outputs = 1 if i == depth - 1 else bias.size
            if weight.shape != (outputs, size) or bias.shape != (outputs,):
                wanted = f"w{i} must be ({outputs}, {size}) and b{i} ({outputs},)"
                raise ValueError(f"{wanted}, got {weight.shape} and {bias.shape}")
            size = outputs
        broken = [name for name, value in known.items() if not np.isfinite(value).all()]
        if broken:
            raise ValueError(f"weights must be finite, {broken[0]} has other numbers")
        self.steps, self.reach = self.linear.size - fixed, float(reach[0])
        self._scales = np.concatenate((scales(self.steps), more))

    def correction(self, senses: np.ndarray) -> float:
        """Return the correction of the line [m]."""
        inputs = x = senses / self._scales
        for weight, bias in self.layers[:-1]:
            x = np.tanh(weight @ x + bias)
        weight, bias = self.layers[-1]
        return self.reach * float(np.tanh(weight @ x + bias + self.linear @ inputs)[0])


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
