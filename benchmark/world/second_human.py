"""A second human at the robot's end of the table."""

from dataclasses import dataclass
from typing import ClassVar

from colift.agents.agent import FRAME
from colift.benchmark.world.human_body import BodyParameters, HumanBody
from colift.benchmark.world.interface import Engine
from colift.benchmark.world.table import GRAVITY


@dataclass(frozen=True)
class HumanFarEnd:
    """A person as the holder of the far end."""

    body: BodyParameters

    carries: ClassVar[bool] = True

    @property
    def mass(self) -> float:
        """Apparent mass of the arms [kg]; it moves with the table's end."""
        return self.body.mass

    def hold(self, engine: Engine) -> "SecondHuman":
        """Return the person's arms; see :meth:`.FarEnd.hold`."""
        return SecondHuman(self.body, engine.physics.step, engine.weight_share)


class SecondHuman:
    """The far end held by a person: the same body as the first, seen from the other side.

    The hands grip the table rigidly, so their mass is part of the table's link (see
    :func:`.table.table_urdf`) and the arms appear as a vertical force on its far end.
    """

    def __init__(self, parameters: BodyParameters, step: float, weight: float) -> None:
        self._body = HumanBody(parameters, step, weight)
        self._weight = parameters.mass * GRAVITY
        self.reset()

    def reset(self) -> None:
        """Relax at rest height."""
        self._body.reset()
        self._previous = self._reference = 0.0

    def prepare(
        self, command: float, own: list[float], other: list[float], force: list[float]
    ) -> None:
        """Accept the reference for the end of the next frame [m] and advance the reflexes.

        ``own``, ``other`` and ``force`` are the histories of :meth:`.HumanBody.reflex`.
        """
        self._previous = self._reference
        self._reference = command + self._body.reflex(own, other, force)

    def drive(self, begin: float, height: float, velocity: float) -> float:
        """Return the arms' force on the far end [N].

        Parameters
        ----------
        begin
            Beginning of the physics step, as a fraction of the frame.
        height, velocity
            Height and velocity of the far end at that time [m, m/s].
        """
        change = self._reference - self._previous
        reference = self._previous + change * begin
        arms = self._body.arm_force(reference, change / FRAME, height, velocity)
        return arms + self._weight

    def hand_height(self, end: float) -> float:
        """Return the height of the hands [m]: they grip the end, at the height ``end``."""
        return end
