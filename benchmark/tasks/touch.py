"""The base of tasks with touch: a finer world, and rules that say what is missed and lost."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Final, NamedTuple, cast

import numpy as np
from colift.agents.rules import SCALARS, ArrayFunctions, Drawn, N, View
from colift.benchmark.episode.metric import Scores
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.benchmark.episode.task import Playing
from colift.benchmark.episode.trace import Trace
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.world.ball import Ball
from colift.benchmark.world.human_body import BodyParameters
from colift.benchmark.world.interface import FarEnd, World
from colift.benchmark.world.physics import Physics
from colift.benchmark.world.table import TABLE, Table
from numpy.typing import NDArray

FINER: Final = Physics(step=0.0025)
"""The physics of the tasks with touch. People and policies that act on touch amplify small
differences: at the usual step the mean error of two people on ``agree-v1`` is 4 % off (``colift
bench --convergence --suite agree-v1``)."""


class Ends(NamedTuple):
    """Read-outs at the end of a frame [m]: numbers, or arrays."""

    near: Any
    """Height of the human's end."""
    far: Any
    """Height of the robot's end."""
    ball: Any
    """Place of the ball; 0 without one."""


def held(squares: Any, stay: int) -> Any:
    """Return the means of ``stay`` successive frames, from each frame that has so many.

    Parameters
    ----------
    squares
        (T,) for one lift, or (T, n) for n lifts [m2]; T is at least ``stay``.
    stay
        Number of frames, 1 or more.
    """
    means = len(squares) - stay + 1
    # No cumulative sums: their rounding in single precision is as large as a square millimetre.
    return sum(squares[first : first + means] for first in range(stay)) / stay


def gathered(squares: Any, stay: int) -> Any:
    """Return the squares of a lift's frames as one number of each lift.

    Parameters
    ----------
    squares
        (T,) for one lift, or (T, n) for n lifts [m2].
    stay
        Frames for which a place has to be held: the least mean over so many successive frames
        (:func:`held`; of a shorter lift, the mean). With 0 it is the sum over all frames.
    """
    return held(squares, min(stay, len(squares))).min(axis=0) if stay else squares.sum(axis=0)


@dataclass(frozen=True, kw_only=True)
class Touch(Level):
    """The base of tasks with touch: subclasses state purpose, end and scores.

    The robot has the senses of sight and of touch, and those of :attr:`senses`. The rules
    :meth:`missed`, :meth:`error`, :meth:`unfinished` and :meth:`lost` are read by the engine and by
    the twin; ``missed`` with NumPy, too, so that it may use arithmetic, ``f.abs`` and ``f.where``
    only.
    """

    touch: ClassVar[bool] = True
    physics: ClassVar[Physics] = FINER
    stays: ClassVar[tuple[int, ...]] = (0,)
    """For each number of :meth:`missed`, how its frames are gathered; see :func:`gathered`."""

    def world(
        self,
        human: BodyParameters,
        far_end: FarEnd,
        table: Table = TABLE,
        *,
        physics: Physics | None = None,
    ) -> World:
        """Return a world with torques at both grips, and with the ball."""
        # The engine is imported where it is used: rules and twin do without.
        from colift.benchmark.world.bullet_world import BulletWorld

        return BulletWorld(
            human,
            far_end,
            table,
            physics=physics or self.physics,
            touch=True,
            ball=self.rolling,
        )

    @property
    def rolling(self) -> Ball | None:
        """The ball on the table, if there is one."""
        return None

    def missed(self, f: ArrayFunctions[N], due: Any, ends: Any) -> Sequence[N]:
        """Return squares of the error in a frame [m2].

        Parameters
        ----------
        f
            The functions of numbers.
        due
            The task's series in this frame.
        ends
            The read-outs (:class:`Ends`) in this frame.
        """
        return ((ends.near - ends.far) ** 2,)

    def error(self, f: ArrayFunctions[N], facts: Any, gathered: Sequence[N], frames: Any) -> N:
        """Return the square of a lift's error [m2].

        Parameters
        ----------
        f
            The functions of numbers.
        facts
            The task's numbers.
        gathered
            The squares of all frames, gathered as :attr:`stays` says.
        frames
            Number of frames.
        """
        error: N = gathered[0] / frames
        return error

    def unfinished(self, f: ArrayFunctions[N], drawn: Drawn[N], view: View[N]) -> N:
        """Return how many frames of the person's plan are still to be done, at the end of a lift.

        Each counts like a frame that a failure cut off, with :data:`.FAILED_FRAME_MM`.
        """
        return 0.0 * view.command

    def lost(self, f: ArrayFunctions[N], ends: Any) -> Any:
        """Return whether the lift is lost in a frame."""
        return f.abs(ends.near) < 0.0

    def rewards(self, lift: Playing) -> tuple[float, float]:
        """Return minus the error in the last frame [m], for both."""
        last, world = lift.frame - 1, lift.world
        due = frame_of(lift.due, last)
        ends = Ends(world.human_end[-1], world.robot_end[-1], world.ball_place[-1])
        missed = -math.sqrt(math.fsum(self.missed(SCALARS, due, ends)))
        return missed, missed

    def is_lost(self, lift: Playing) -> bool:
        """Return whether the lift was lost in the step just made."""
        world, size = lift.world, lift.frames_per_step
        read = (world.human_end[-size:], world.robot_end[-size:], world.ball_place[-size:])
        return any(self.lost(SCALARS, Ends(*each)) for each in zip(*read, strict=True))

    def failure(self, lift: Playing) -> str | None:
        """Return how the table was dropped or the lift lost in the step just made, or None."""
        lost = self.is_lost(lift)
        return f"the task {self.name!r} is lost" if lost else super().failure(lift)

    def rmse_mm(self, lift: Playing, trace: Trace, ball: Any = 0.0) -> float:
        r"""Return the root mean square error of a lift [mm].

        .. math:: \sqrt{\frac{T e^2 + M \cdot 250^2}{T + M}}

        with the error e of the T frames that were played. M frames are missing: those that a
        failure cut off, or those of the plan that are unfinished, whichever are more. Each counts
        with :data:`.FAILED_FRAME_MM`.
        """
        frames = len(trace.human_end)
        if frames == 0:
            return FAILED_FRAME_MM
        due = {name: series[:frames] for name, series in _series(lift.due).items()}
        ends = Ends(trace.human_end, trace.robot_end, ball)
        found = self.missed(cast(Any, np), type(lift.due)(**due) if due else (), ends)
        squares = [
            float(gathered(each, stay)) for each, stay in zip(found, self.stays, strict=True)
        ]
        error = self.error(SCALARS, lift.facts, squares, frames)
        missing = max(lift.horizon - frames, self.unfinished(SCALARS, lift.drawn, lift))
        cut = missing * FAILED_FRAME_MM**2
        return math.sqrt((1e6 * frames * error + cut) / (frames + missing))

    def series(self, lift: Playing) -> Mapping[str, NDArray[np.float64]]:
        """Return the task's series, the place of the ball, and the torque of the robot's hands."""
        frames, world = lift.frame, lift.world
        found = {name: series[:frames] for name, series in _series(lift.due).items()}
        if self.rolling is not None:
            found["ball"] = np.array(world.ball_place[-frames:][:frames])
        return {**found, "robot_torque": torque_of(lift)}

    def score(self, lift: Playing, trace: Trace, *, failed: bool) -> Scores:
        """Return the error alone."""
        return {"rmse_mm": self.rmse_mm(lift, trace, trace.added.get("ball", 0.0))}


def _series(due: Any) -> dict[str, Any]:
    """Return a named tuple's series by name."""
    return due._asdict() if due else {}


def frame_of(due: Any, frame: int) -> Any:
    """Return a named tuple's series in a frame."""
    return type(due)(*(float(series[frame]) for series in due)) if due else due


def torque_of(lift: Playing) -> Any:
    """Return the torque of the robot's hands in each frame since the beginning [Nm]."""
    return np.array(lift.world.robot_torque[-lift.frame :][: lift.frame])
