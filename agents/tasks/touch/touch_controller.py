"""Control of the hand by a recurrent network of sight and touch, and its file of weights."""

import io
import math
import zipfile
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.control.portable import PORTABLE
from colift.agents.control.recurrent import network_of
from colift.agents.senses import Sense
from colift.agents.tasks.touch.alone_law import law_of, ports_of
from colift.agents.tasks.touch.touch_law import TouchNetwork, touch_at_rest
from colift.base.errors import InputError


class TouchController:
    """The control law of :func:`.felt_action`, or of :func:`.alone_action`, with given weights.

    Parameters
    ----------
    learned
        The weights, and their task.
    """

    def __init__(self, learned: TouchNetwork) -> None:
        self._learned, self._law = learned, law_of(learned)

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._memory = touch_at_rest(self._learned)

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m].

        Raises
        ------
        InputError
            If the observation is that of another task.
        """
        observation = np.asarray(observation, dtype=np.float64)
        if observation.shape != (self._learned.expected,):
            raise InputError(
                f"these weights are of the task {self._learned.task!r}, whose observation has "
                f"{self._learned.expected} numbers; got {observation.shape}"
            )
        self._memory, change = self._law(self._learned, self._memory, observation, PORTABLE)
        return np.array([change])


def read_touch(file: Path | Traversable) -> TouchNetwork:
    """Return the network of an ``.npz`` file, which names its task.

    Raises
    ------
    InputError
        If the file cannot be read, or as :func:`touch_network`.
    """
    try:
        with np.load(io.BytesIO(file.read_bytes()), allow_pickle=False) as arrays:
            return touch_network(arrays, file.name)
    except (OSError, ValueError, EOFError, zipfile.BadZipFile) as error:
        raise InputError(f"{file.name}: not an .npz file of weights: {error}") from None


def touch_network(arrays: Any, source: str) -> TouchNetwork:
    """Return the network of named arrays and of their ``task``, in double precision.

    Raises
    ------
    InputError
        If an array is missing, of a wrong shape, or not finite.
    """
    if "task" not in arrays:
        raise InputError(f"{source}: not the weights of a policy by touch: task is missing")
    senses = senses_of(arrays, source)
    alone = "alone" in arrays and bool(np.asarray(arrays["alone"]).all())
    network = network_of(arrays, source, *ports_of(senses, alone=alone))
    return TouchNetwork(str(arrays["task"]), senses, network, alone)


def senses_of(arrays: Any, source: str) -> tuple[Sense, ...]:
    """Return the senses of the weights' task besides sight and touch, as their network needs them.

    The array ``scales`` has a row with scale and rate for each.

    Raises
    ------
    InputError
        If it is missing, of a wrong shape or not finite.
    """
    if "scales" not in arrays:
        raise InputError(f"{source}: not the weights of a policy by touch: scales is missing")
    scales = np.asarray(arrays["scales"])
    if scales.ndim != 2 or scales.shape[1] != 2 or scales.dtype.kind not in "fiu":
        raise InputError(f"{source}: scales must have the shape (k, 2), got {scales.shape}")
    if not np.isfinite(scales).all():
        raise InputError(f"{source}: scales has numbers that are not finite")
    return tuple(
        Sense("", -math.inf, math.inf, "", scale=scale, rate=rate)
        for scale, rate in scales.astype(np.float64).tolist()
    )
