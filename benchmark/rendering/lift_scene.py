"""The scene of a lift that has been played, frame by frame, with what its task shows."""

from collections.abc import Sequence
from types import TracebackType
from typing import Self

from colift.benchmark.episode.drawn import (
    DrawnSeries,
    ball_and_target,
    drawn_hurdles,
    intended_far_end,
)
from colift.benchmark.episode.trace import Trace
from colift.benchmark.rendering.cameras import SIDE
from colift.benchmark.rendering.scene import Scene


class LiftScene:
    """A scene that shows the frames of a trace; a context manager that closes it.

    Parameters
    ----------
    trace
        The lift.
    partner
        Holder of the robot's end.
    drawn
        What its task shows.
    camera
        Name of the camera.
    """

    def __init__(
        self, trace: Trace, partner: str, drawn: Sequence[DrawnSeries] = (), camera: str = SIDE
    ) -> None:
        self.partner = partner
        self._trace = trace
        self._goal, self._rolling = intended_far_end(drawn), ball_and_target(drawn)
        self._hurdles = drawn_hurdles(drawn, trace)
        self.scene = Scene(
            partner,
            intended=self._goal is not None,
            ball=self._rolling is not None,
            hurdles=self._hurdles,
            camera=camera,
        )
        """The scene, as :meth:`show` has posed it."""

    def __enter__(self) -> Self:
        """Return the scene."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Close the engine."""
        self.scene.close()

    def show(self, frame: int) -> None:
        """Pose everything as in a frame."""
        trace, table = self._trace, self.scene.table
        self.scene.pose(float(trace.human_end[frame]), float(trace.robot_end[frame]))
        if self._goal is not None:
            meant = float(trace.added[self._goal.name][frame])
            table.intend(float(trace.target[frame]), meant)
        if self._rolling is not None:
            ball, target = (float(trace.added[each.name][frame]) for each in self._rolling)
            table.roll(ball, target)
        table.open([each.open_at(frame) for each in self._hurdles])
