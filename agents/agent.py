"""The interface of every agent, human or robot, and the layout of observations.

Heights are displacements [m] from the table's rest height, z up.
"""

from enum import IntEnum
from typing import Final, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

FRAME: Final = 0.01
"""Motion-capture frame [s]: 100 Hz, as in the paper (section II.A)."""

HISTORY: Final = 10
"""Frames of the past that a human's observation holds."""

Observation = NDArray[np.float64]
Action = NDArray[np.float64]


@runtime_checkable
class Agent(Protocol):
    """Anything that can hold an end of the table."""

    def reset(self, seed: int) -> None:
        """Begin an episode. All randomness of the episode comes from ``seed``."""

    def act(self, observation: Observation) -> Action:
        """Return the action for the next control period."""


@runtime_checkable
class Remembering(Protocol):
    """An agent that keeps what it learns in a lift for the next ones with the same person."""

    def begin_session(self) -> None:
        """Begin with a new person; the lifts of the session follow, each after a ``reset``."""


@runtime_checkable
class Explaining(Protocol):
    """An agent that explains its last action."""

    def internals(self) -> dict[str, float]:
        """Return named numbers, the same names after every action.

        By convention ``prediction`` is a predicted height of the human's end [m], ``confidence``
        is in [0, 1], and ``role`` is 1 for a leader and 0 for a follower.
        """


@runtime_checkable
class Printing(Protocol):
    """An agent in a process of its own, with captured output."""

    @property
    def printed(self) -> str:
        """Return the end of its output to stdout and stderr since the reset."""


@runtime_checkable
class Resuming(Protocol):
    """An agent in a process of its own, in which ``reset`` begins a session."""

    def resume(self, seed: int) -> None:
        """Begin the next lift of the session: the policy's ``reset``, and all that it remembers."""


class RobotObservation(IntEnum):
    """Index table of the robot's observation, version 1: everything that a robot policy perceives.

    The two table ends come from motion capture: one sample per step, ``latency`` old, noisy.
    The hand's height comes from its own encoders and is fresh.
    """

    HUMAN_END = 0
    """Height of the human's table end [m], motion capture."""
    ROBOT_END = 1
    """Height of the robot's table end [m], motion capture."""
    HAND_HEIGHT = 2
    """Height of the robot's hand [m], encoders, age 0."""
    HAND_COMMAND = 3
    """Command of the robot's hand [m] at the start of this step, age 0."""
    TIME = 4
    """Time since the episode began [s]."""


class HumanObservation:
    """Index table of the human's observation, for ``n`` frames per step (10 by default).

    Histories hold the last ten frames, oldest first.
    """

    OWN_HEIGHT: Final = slice(0, HISTORY)
    """Height of the human's own table end [m] in the last ten frames."""
    OWN_VELOCITY: Final = slice(HISTORY, 2 * HISTORY)
    """Velocity of the human's own table end [m/s] in the last ten frames."""
    OTHER_END: Final = slice(2 * HISTORY, 3 * HISTORY)
    """Height of the other table end [m] in ten frames, as old as the visual delay."""
    HAND_FORCE: Final = slice(3 * HISTORY, 4 * HISTORY)
    """Force of the hands on the table [N], upwards positive, in ten frames as old as the haptic
    delay."""
    TARGET: Final = slice(4 * HISTORY, -1)
    """The private target: the intended height [m] in each of the next ``n`` frames."""
    TIME: Final = -1
    """Time since the episode began [s]."""

    @staticmethod
    def size(frames: int) -> int:
        """Return the length of the observation for ``frames`` frames per step."""
        return 4 * HISTORY + frames + 1
