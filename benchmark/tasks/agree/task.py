"""The task to agree on two private hurdles, and its suite."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Final, NamedTuple

import numpy as np
from colift.agents.agent import FRAME, Agent, Observation
from colift.agents.humans import Plan
from colift.agents.humans.person import Person
from colift.agents.rules import SCALARS, ArrayFunctions, Drawn, N, View
from colift.agents.senses import Sense
from colift.agents.tasks.agree.observation import HURDLE_SENSES
from colift.base.errors import InputError
from colift.benchmark.episode import metrics
from colift.benchmark.episode.lift import lasting
from colift.benchmark.episode.metric import Metrics, Scores
from colift.benchmark.episode.task import Bounds, Playing
from colift.benchmark.episode.trace import Trace
from colift.benchmark.suites.people import people_suite
from colift.benchmark.suites.ranges import AGREE_PEOPLE
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.agree.hurdles import Hurdle, HurdlePlan
from colift.benchmark.tasks.agree.person import Negotiates
from colift.benchmark.tasks.agree.precedence import Obstacle, secret
from colift.benchmark.tasks.agree.scores import (
    STAY,
    agreement_ms,
    agreement_rmse_mm,
    leading_mw,
    missed_mm,
    passing,
)
from colift.benchmark.tasks.agree.second import SecondNegotiator, with_secret
from colift.benchmark.tasks.agree.table import AGREE_METRICS
from colift.benchmark.tasks.touch import Touch, torque_of
from colift.benchmark.world.table import WEIGHT_SHARE
from numpy.typing import NDArray

MOST_UNCERTAIN: Final = 1.0
"""Largest uncertainty of the far end's speed [m/s]: its speed is then practically unknown."""

NEVER: Final = 2.0 * STAY
"""Square distance from a hurdle outside its window [m2]: a stay with one such frame is farther away
than any within the window."""


class Windows(NamedTuple):
    """The task's series: 1 in some frames, 0 in the others."""

    human: Any
    """In the window of the human's hurdle."""
    robot: Any
    """In the window of the robot's hurdle."""
    held: Any
    """At the common height, where there is something to agree on."""
    over_human: Any
    """The common way with the height of the human's hurdle in its window [m]."""
    over_robot: Any
    """The same for the robot's hurdle."""


class Facts(NamedTuple):
    """The task's numbers."""

    human: Obstacle[Any]
    robot: Obstacle[Any]
    held: Any
    """Number of frames at the common height."""
    uncertainty: Any
    """:attr:`.Agree.uncertainty`."""


def hurdles_of(plan: Plan) -> tuple[Hurdle | None, Hurdle | None]:
    """Return the hurdles of the human and of the robot's end."""
    return (plan.own, plan.other) if isinstance(plan, HurdlePlan) else (None, None)


@dataclass(frozen=True, kw_only=True)
class Agree(Touch):
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
    person: ClassVar[Person] = Negotiates()
    second_human: ClassVar[type[Agent]] = SecondNegotiator
    behaviours: ClassVar[tuple[str, ...]] = (
        "abreast",
        "ahead",
        "behind",
        "own_hurdle",
        "other_hurdle",
        "no_hurdle",
    )
    senses: ClassVar[tuple[Sense, ...]] = HURDLE_SENSES
    stays: ClassVar[tuple[int, ...]] = (STAY, STAY, 0)

    def __post_init__(self) -> None:
        """Check the range."""
        if not 0.0 <= self.uncertainty <= MOST_UNCERTAIN:
            raise InputError(
                f"uncertainty must be between 0 and {MOST_UNCERTAIN} m/s, got {self.uncertainty}"
            )

    def setting(self, plan: Plan, frames: int, seed: Callable[[str], int]) -> tuple[Windows, Facts]:
        """Return the windows of the hurdles and of the common height, and the hurdles."""
        way = lasting(plan.target, frames)
        hurdles = hurdles_of(plan)
        own, other = (_window(hurdle, frames) for hurdle in hurdles)
        first, past = plan.agreeing if isinstance(plan, HurdlePlan) else (0, frames)
        held = np.zeros(frames)
        held[first:past] = 1.0
        human, robot = map(_obstacle, hurdles)
        over, over_other = (
            np.where(window > 0.0, obstacle.height, way)
            for window, obstacle in ((own, human), (other, robot))
        )
        facts = Facts(human, robot, float(held.sum()), self.uncertainty)
        return Windows(own, other, held, over, over_other), facts

    def observe(self, f: ArrayFunctions[N], drawn: Drawn[N], view: View[N]) -> Sequence[N]:
        """Return the robot's own hurdle."""
        return secret(f, drawn.facts.robot, view.frame)

    def missed(self, f: ArrayFunctions[N], due: Any, ends: Any) -> Sequence[N]:
        """Return the square distances from both hurdles, and the square height difference."""
        human, robot = (
            f.where(window > 0.0, passing(over, ends.near, ends.far), NEVER)
            for window, over in ((due.human, due.over_human), (due.robot, due.over_robot))
        )
        return human, robot, due.held * (ends.near - ends.far) ** 2

    def error(self, f: ArrayFunctions[N], facts: Any, gathered: Sequence[N], frames: Any) -> N:
        """Return the mean of the squares that the lift has; see :func:`.agreement_rmse_mm`."""
        human, robot, level = gathered
        given = facts.human.given, facts.robot.given
        missed = given[0] * human + given[1] * robot
        error: N = (missed + level / facts.held) / (1.0 + given[0] + given[1])
        return error

    def human_observation(self, lift: Playing) -> Observation:
        """Return the human's hurdle, the senses and the common way of the coming step."""
        own = secret(SCALARS, lift.facts.human, lift.frame)
        return with_secret(lift.human_view(lift.planned()), own, self.uncertainty)

    def second_person_observation(self, lift: Playing) -> Observation:
        """Return the second human's hurdle, which is the robot's, and the senses."""
        own = secret(SCALARS, lift.facts.robot, lift.frame)
        return with_secret(super().second_person_observation(lift), own, self.uncertainty)

    def human_bounds(self, frames: int) -> Bounds:
        """Return the bounds of the humans' observations."""
        low, high = super().human_bounds(frames)
        own = [each.high for each in HURDLE_SENSES]
        bound = np.array([*own, MOST_UNCERTAIN])
        return np.concatenate((-bound, low)), np.concatenate((bound, high))

    def rewards(self, lift: Playing) -> tuple[float, float]:
        """Return minus the height difference and the distances from the open hurdles [m].

        The human's reward counts only the human's hurdle, the robot's counts both.
        """
        near, far = lift.world.human_end[-1], lift.world.robot_end[-1]
        level = abs(near - far)
        missed = [
            (abs(near - hurdle.height) + abs(far - hurdle.height)) / 2
            if hurdle is not None and hurdle.start <= lift.frame < hurdle.stop
            else 0.0
            for hurdle in hurdles_of(lift.plan)
        ]
        return -level - missed[0], -level - math.fsum(missed)

    def series(self, lift: Playing) -> Mapping[str, NDArray[np.float64]]:
        """Return the hurdles in their windows, the common way elsewhere; the robot's torque."""
        frames = lift.frame
        return {
            "human_hurdle": lift.due.over_human[:frames],
            "robot_hurdle": lift.due.over_robot[:frames],
            "robot_torque": torque_of(lift),
        }

    def score(self, lift: Playing, trace: Trace, *, failed: bool) -> Scores:
        """Return the scores of :data:`.AGREE_METRICS`."""
        near, far = trace.human_end, trace.robot_end
        human, robot = hurdles_of(lift.plan)
        felt, borne = trace.human_force - WEIGHT_SHARE, trace.robot_force - WEIGHT_SHARE
        nan, empty = math.nan, len(near) == 0
        missed = missed_mm(human, near, far), missed_mm(robot, near, far)
        held = lift.due.held[: len(near)] > 0.0
        ends = near[held], far[held]
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


def _obstacle(hurdle: Hurdle | None) -> Obstacle[float]:
    """Return a hurdle in numbers."""
    if hurdle is None:
        return Obstacle(0.0, 0.0, 0.0, 0.0)
    return Obstacle(hurdle.height, float(hurdle.start), float(hurdle.stop), 1.0)


def _window(hurdle: Hurdle | None, frames: int) -> NDArray[np.float64]:
    """Return 1 in the frames of a hurdle's window, else 0."""
    window = np.zeros(frames)
    if hurdle is not None:
        window[hurdle.start : hurdle.stop] = 1.0
    return window


def agree_suite() -> Suite:
    """25 people x 6 kinds of hurdles: half with two hurdles, a third with one."""
    return people_suite("agree-v1", Agree.name, Agree.behaviours, AGREE_PEOPLE)
