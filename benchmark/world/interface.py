"""The interface of the physics: a world stepped frame by frame, and the hands at its far end."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Protocol, Self, runtime_checkable

import numpy as np
from colift.benchmark.world.physics import Physics
from colift.benchmark.world.table import WEIGHT_SHARE
from numpy.typing import NDArray

HISTORY_FRAMES: Final = 50
"""Frames of rest before an episode, long enough for every delay up to 0.5 s."""


Intended = tuple[Sequence[float], Sequence[float]]
"""A person's intention: the height of the far end above the near one at the end of each frame [m],
from which the reflexes correct deviations, and the pitch that the wrists turn towards [rad]."""


class World(Protocol):
    """A person, a table and a holder of its far end, stepped one motion-capture frame at a time.

    Read-outs are histories with one entry per frame since the last reset, newest last, preceded by
    ``HISTORY_FRAMES`` entries of rest. Heights are displacements from rest [m], velocities [m/s],
    forces [N] of the hands on the table, upwards positive.

    :class:`.BulletWorld` is the implementation that scores.
    """

    human_end: list[float]
    """Height of the human's table end."""
    human_velocity: list[float]
    """Its vertical velocity."""
    robot_end: list[float]
    """Height of the robot's table end."""
    robot_velocity: list[float]
    """Its vertical velocity."""
    human_force: list[float]
    """Force of the human's hands on the table."""
    robot_force: list[float]
    """Force of the hands at the far end on the table."""
    robot_torque: list[float]
    """Torque of the far hands on the table about their grip [Nm], positive if it raises the far
    end; 0 in a world without touch, whose histories of torque and ball may not grow."""
    ball_place: list[float]
    """Place of the ball on the table [m], from the middle towards the far end."""
    ball_speed: list[float]
    """Speed of the ball's centre along the table [m/s]."""
    hand_height: float
    """Present height of the hands at the far end; for a NAO, from its encoders."""

    def reset(self) -> None:
        """Restore the state of rest, bit for bit the same each time."""

    def advance(
        self,
        human_reference: Sequence[float],
        robot_reference: Sequence[float],
        intended: Intended | None = None,
    ) -> None:
        """Advance by as many frames as the references have entries.

        Parameters
        ----------
        human_reference
            The height that the human's arms pull towards at the end of each frame [m].
        robot_reference
            The height that the arms at the far end pull towards [m]; for a NAO, the commanded
            height of its hands.
        intended
            The person's intention in these frames; None if it stays. At rest it is a level table.
        """

    def state(self) -> tuple[float, ...]:
        """Return the last frame's read-outs, and the height of the hand."""

    def close(self) -> None:
        """Release the engine; the world cannot be used afterwards."""


@dataclass(frozen=True, kw_only=True)
class Engine:
    """A simulation in which the hands of a :class:`FarEnd` hold the table."""

    physics: Physics
    weight_share: float = WEIGHT_SHARE
    """The weight that each end carries when the table is level and still [N]."""


class Hands(Protocol):
    """The hands at the far end of the table, inside a world."""

    def reset(self) -> None:
        """Return to rest height; the world restores the engine's state."""

    def prepare(
        self, command: float, own: list[float], other: list[float], force: list[float]
    ) -> None:
        """Accept the height to reach at the end of the next frame [m].

        Parameters
        ----------
        command
            Commanded height of a robot's hands, or the height that a person's arms pull towards.
        own, other, force
            Histories, newest last: heights of the far and of the near end [m], and the force of
            the hands on the table [N].
        """

    def drive(self, begin: float, height: float, velocity: float) -> float:
        """Act during the physics step that begins at ``begin``, a fraction of the frame.

        Parameters
        ----------
        begin
            Beginning of the physics step as a fraction of the frame.
        height, velocity
            Height and velocity of the far end at that time [m, m/s].

        Returns
        -------
        float
            Force of the hands on the far end [N] that is not already in the engine.
        """

    def hand_height(self, end: float) -> float:
        """Return the height of the hands [m] when the table's end is at the height ``end``."""


class FarEnd(Protocol):
    """A holder that is not in a world yet."""

    @property
    def mass(self) -> float:
        """Mass that moves with the table's end [kg]."""

    @property
    def carries(self) -> bool:
        """Whether it carries half of all weight on the table without feeling it, as people do."""

    def hold(self, engine: Engine) -> Hands:
        """Grip the table in an engine at the far end, and return the hands."""


@runtime_checkable
class Adjustable(FarEnd, Protocol):
    """A robot whose arms can be exchanged for weaker or slower ones."""

    def with_arms(self, sag: float, gain: float) -> Self:
        """Return the same robot with other arms.

        Parameters
        ----------
        sag
            Factor of the displacement of its hands by weight and load.
        gain
            Factor of the share of a deviation from the set-point that is gone after a frame; below
            1, the arms are slower.
        """


def since_reset(history: list[float]) -> NDArray[np.float64]:
    """Return a history of a world without the frames of rest before its reset."""
    return np.array(history[HISTORY_FRAMES:])
