"""The robot's estimate of the ball now and soon, and of the intention in the human's wrists."""

from typing import Final

from colift.agents.agent import FRAME, Observation
from colift.agents.tasks.ball.ball_filter import BallFilter
from colift.agents.tasks.ball.facts import meant_by_wrists
from colift.agents.tasks.ball.inclining import Inclining
from colift.agents.tasks.ball.observation import BallObservation

LATENCY: Final = 0.1
"""Assumed age of the seen places and heights [s]."""

SENSED: Final = 0.025
"""Mean age of a sensed force [s]."""


class Tracking:
    """Extrapolates the seen ball to the present by the height differences since the sample.

    Between the newest sample and now the difference is a ramp from the seen one to that between the
    robot's hand and the forecast of the human's end.
    """

    def reset(self) -> None:
        """Begin an episode."""
        self.inclining = Inclining()
        self.inclining.reset()
        self._filter = BallFilter()
        self._filter.reset()
        self._seen = 0.0

    @property
    def sample(self) -> tuple[float, float]:
        """Place and speed of the ball at the newest sample [m, m/s]."""
        return self._filter.place, self._filter.speed

    def observe(self, observation: Observation) -> None:
        """Add the newest observation."""
        inclining = self.inclining
        inclining.observe(observation)
        ends = observation[[BallObservation.HUMAN_END, BallObservation.ROBOT_END]].tolist()
        before, self._seen = self._seen, ends[1] - ends[0]
        place = float(observation[BallObservation.BALL_PLACE])
        self._filter.update(place, (before + self._seen) / 2, inclining.period)
        self._now = float(observation[BallObservation.HAND_HEIGHT]) - inclining.height(0.0)
        self._command = float(observation[BallObservation.HAND_COMMAND]) - inclining.sag
        self._force = float(observation[BallObservation.FORCE])

    def ahead(self, time: float) -> tuple[float, float]:
        """Return the ball's place and speed a time from now [m, m/s] if the command stays."""
        differences = _ramp(self._seen, self._now, LATENCY)
        then = self._command - self.inclining.height(time)
        return self._filter.ahead(differences + _ramp(self._now, then, time), FRAME)

    def meant(self) -> float:
        """Return the height difference that the human's wrists seem to mean [m]."""
        difference = self._now + (self._seen - self._now) * SENSED / LATENCY
        return meant_by_wrists(self._force, difference, self.ahead(0.0)[0])


def _ramp(first: float, last: float, time: float) -> list[float]:
    """Return the values of a ramp at the middle of each frame."""
    frames = round(time / FRAME)
    return [first + (last - first) * (frame + 0.5) / frames for frame in range(frames)]
