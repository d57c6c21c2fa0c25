"""The task to agree on two private hurdles, and its suite."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np
from colift.agents.agent import FRAME, Agent, Observation
from colift.agents.errors import InputError
from colift.agents.humans import SUBJECTS
from colift.agents.humans.agree import SecondNegotiator, with_secret
from colift.benchmark.episode import metrics
from colift.benchmark.episode.level import HEIGHT_BOUND, LONGEST_EPISODE
from colift.benchmark.episode.metric import Metrics, Scores
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.task import Bounds, Playing
from colift.benchmark.episode.trace import Trace
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.agree.lift import AgreeLift
from colift.benchmark.tasks.agree.scores import (
    agreement_ms,
    agreement_rmse_mm,
    leading_mw,
    missed_mm,
)
from colift.benchmark.tasks.agree.table import AGREE_METRICS
from colift.benchmark.tasks.haptic import Haptic
from colift.benchmark.world.table import WEIGHT_SHARE
from numpy.typing import NDArray

BEHAVIOURS = ("abreast", "ahead", "behind", "own_hurdle", "other_hurdle", "no_hurdle")

MOST_UNCERTAIN: Final = 1.0
"""Largest uncertainty of the far end's speed [m/s]: its speed is then practically unknown."""


@dataclass(frozen=True, kw_only=True)
class Agree(Haptic):
    """Lift together, and pass a private hurdle of each on the way, with the whole table.

    The robot has :class:`.AgreeObservation`, with its own hurdle but not the human's. The human and
    the second human each have their own hurdle and :class:`.HumanObservation`; see
    :func:`.with_secret`.

    Raises
    ------
    InputError
        If the uncertainty is negative or above :data:`MOST_UNCERTAIN`.
    """

    uncertainty: float = 0.01
    """Standard deviation of the error of the perceived speed of the far end [m/s]: the less people
    know about each other, the larger it is."""

    name: ClassVar[str] = "agree"
    metrics: ClassVar[Metrics] = AGREE_METRICS
    second_human: ClassVar[type[Agent]] = SecondNegotiator

    def __post_init__(self) -> None:
        """Check the range."""
        if not 0.0 <= self.uncertainty <= MOST_UNCERTAIN:
            raise InputError(
                f"uncertainty must be between 0 and {MOST_UNCERTAIN} m/s, got {self.uncertainty}"
            )

    def lift(self, scenario: Scenario) -> AgreeLift:
        """Return a lift with hurdles."""
        return AgreeLift(scenario)

    def robot_observation(self, lift: Playing) -> Observation:
        """Return the robot's senses and its own hurdle."""
        assert isinstance(lift, AgreeLift)
        return np.concatenate((lift.haptic_view(), lift.secret(lift.robot_hurdle)))

    def human_observation(self, lift: Playing) -> Observation:
        """Return the human's hurdle, the senses and the common way of the coming step."""
        assert isinstance(lift, AgreeLift)
        view, secret = super().human_observation(lift), lift.secret(lift.human_hurdle)
        return with_secret(view, secret, self.uncertainty)

    def partner_observation(self, lift: Playing) -> Observation:
        """Return the second human's hurdle, which is the robot's, and the senses."""
        assert isinstance(lift, AgreeLift)
        view, secret = super().partner_observation(lift), lift.secret(lift.robot_hurdle)
        return with_secret(view, secret, self.uncertainty)

    def robot_bounds(self) -> Bounds:
        """Return the bounds of :class:`.AgreeObservation`."""
        low, high = super().robot_bounds()
        return np.concatenate((low, -_SECRET_BOUND)), np.concatenate((high, _SECRET_BOUND))

    def human_bounds(self, frames: int) -> Bounds:
        """Return the bounds of the humans' observations."""
        low, high = super().human_bounds(frames)
        bound = np.append(_SECRET_BOUND, MOST_UNCERTAIN)
        return np.concatenate((-bound, low)), np.concatenate((bound, high))

    def rewards(self, lift: Playing) -> tuple[float, float]:
        """Return minus the height difference and the distances from the open hurdles [m].

        The human's reward counts only the human's hurdle, the robot's counts both.
        """
        assert isinstance(lift, AgreeLift)
        near, far = lift.world.human_end[-1], lift.world.robot_end[-1]
        level = abs(near - far)
        missed = [
            (abs(near - hurdle.height) + abs(far - hurdle.height)) / 2
            if hurdle is not None and hurdle.start <= lift.frame < hurdle.stop
            else 0.0
            for hurdle in (lift.human_hurdle, lift.robot_hurdle)
        ]
        return -level - missed[0], -level - math.fsum(missed)

    def series(self, lift: Playing) -> Mapping[str, NDArray[np.float64]]:
        """Return the hurdles in their windows, the common way elsewhere; the robot's torque."""
        assert isinstance(lift, AgreeLift)
        frames = lift.frame
        return {
            "human_hurdle": lift.way_over(lift.human_hurdle)[:frames],
            "robot_hurdle": lift.way_over(lift.robot_hurdle)[:frames],
            "robot_torque": np.array(lift.world.robot_torque[-frames:][:frames]),
        }

    def score(self, lift: Playing, trace: Trace, *, failed: bool) -> Scores:
        """Return the scores of :data:`.AGREE_METRICS`."""
        assert isinstance(lift, AgreeLift)
        near, far = trace.human_end, trace.robot_end
        human, robot = lift.human_hurdle, lift.robot_hurdle
        felt, borne = trace.human_force - WEIGHT_SHARE, trace.robot_force - WEIGHT_SHARE
        nan, empty = math.nan, len(near) == 0
        missed = missed_mm(human, near, far), missed_mm(robot, near, far)
        ends = near[lift.agreeing], far[lift.agreeing]
        level = metrics.rmse_mm(*ends) if len(ends[0]) else nan
        power = felt * trace.human_velocity
        other = power if empty else borne * np.gradient(far, FRAME)
        return {
            "rmse_mm": agreement_rmse_mm((*missed, level), len(near), lift.horizon),
            "human_hurdle_mm": missed[0],
            "robot_hurdle_mm": missed[1],
            "level_mm": level,
            "tilt_mm": nan if empty else metrics.rmse_mm(near, far),
            "human_force_n": nan if empty else metrics.human_force_n(felt),
            "agreement_ms": nan if failed else agreement_ms((human, robot), near, far),
            "human_leads_mw": nan if failed else leading_mw(human, near, power, other),
            "robot_leads_mw": nan if failed else leading_mw(robot, far, other, power),
            "clipped": lift.clipped(trace.action),
        }


_SECRET_BOUND = np.array((HEIGHT_BOUND, LONGEST_EPISODE, LONGEST_EPISODE, 1.0))


def agree_suite() -> Suite:
    """5 subjects x 6 kinds of hurdles x 4 lifts: half with two hurdles, a third with one."""
    scenarios = tuple(
        make_scenario(behaviour, subject, task=Agree.name)
        for behaviour in BEHAVIOURS
        for subject in SUBJECTS
    )
    return Suite(name="agree-v1", scenarios=scenarios, seeds=tuple(range(4)))
