"""One episode: an agent at the robot's end, a scripted human at the other, and what came of it."""

import functools
import math
import time
from dataclasses import asdict, dataclass

import numpy as np

from ..agents.agent import Agent, Explaining
from . import metrics
from .lift import Lift
from .seeding import derive_seed
from .smoothness import ldlj, sparc
from .trace import Trace
from .world.table import TABLE_LENGTH, WEIGHT_SHARE

REACHED = 0.02
"""The human has reached the intended height if it comes within this of it [m]."""


@dataclass(frozen=True, kw_only=True)
class Scores:
    """The metrics of one episode; NaN where there is none."""

    rmse_mm: float
    abs_error_mm: float
    max_tilt_deg: float
    sparc: float
    ldlj: float
    human_force_n: float
    human_work_j: float
    robot_lag_ms: float
    short_of_goal_mm: float
    """How far below the intended height the human's end stayed [mm]; above 20 mm it has not
    reached it. Negative when it went beyond."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Episode:
    """The outcome of one episode."""

    behaviour: str
    subject: str
    trial: str
    """Name of the recording, empty for a drawn plan."""
    seed: int
    scores: Scores
    failure: str | None
    """Why the episode ended early, or nothing if it did not."""
    trace: Trace
    step_times: tuple[float, ...]
    """What each call of the policy took [s]; the only field that differs between two runs."""

    @property
    def reached(self) -> bool:
        """Whether the human's end reached the intended height."""
        return self.scores.short_of_goal_mm <= 1000 * REACHED

    def row(self) -> dict[str, object]:
        """Return the episode as one row of a table."""
        return {
            "behaviour": self.behaviour,
            "subject": self.subject,
            "trial": self.trial,
            "seed": self.seed,
            **asdict(self.scores),
            "reached": self.reached,
            "failure": self.failure or "",
        }


def policy_seed(key: bytes = b"") -> int:
    """Return the seed that a policy is reset with: the same in every episode.

    A policy's seed must tell nothing of the episode. One derived from the episode's would not do:
    there are few enough public seeds to try them all. A policy that wants to vary from episode to
    episode can mix its first observation in, which carries the sensors' noise.
    """
    return derive_seed(0, "policy", key=key)


def run_episode(lift: Lift, partner: Agent, seed: int) -> Episode:
    """Play one episode and score it.

    Whatever the partner does, this returns: an exception or an unusable action of the partner
    ends the episode with the reason, and the remaining frames count as the worst.

    Parameters
    ----------
    lift
        The lift; it is reset here and may be used for any number of episodes.
    partner
        Who acts at the robot's end.
    seed
        The episode's seed: plan, noise and human follow from it, whoever the partner is.
    """
    lift.reset(seed)
    human = lift.scripted_human()
    actions: list[object] = []
    internals: list[dict[str, float]] = []
    times: list[float] = []
    failure: str | None = None
    explaining = partner if isinstance(partner, Explaining) else None
    clock = time.perf_counter
    try:
        partner.reset(policy_seed())
    except (Exception, SystemExit) as error:
        failure = f"start: {_told(error)}"
    while failure is None and not lift.done:
        observation = lift.partner_observation()
        begin = clock()
        try:
            action = partner.act(observation)
        except (Exception, SystemExit) as error:
            failure = f"step {len(actions)}: {_told(error)}"
            break
        times.append(clock() - begin)
        try:
            lift.step(human.act(lift.human_observation()), action)
        except ValueError as error:
            failure = f"step {len(actions)}: {error}"
            break
        actions.append(action)
        if explaining is not None:
            internals.append(explaining.internals())
    failure = failure or lift.dropped
    trace = _trace(lift, actions, internals)
    scenario = lift.scenario
    return Episode(
        behaviour=scenario.behaviour,
        subject=scenario.subject.name,
        trial=scenario.trial,
        seed=seed,
        scores=score(lift, trace, failed=failure is not None),
        failure=failure,
        trace=trace,
        step_times=tuple(times),
    )


def _told(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}".rstrip(": ")


def _trace(lift: Lift, actions: list[object], internals: list[dict[str, float]]) -> Trace:
    world = lift.world
    width = 1 if lift.scenario.partner == "nao" else lift.frames_per_step
    return Trace(
        human_end=world.since_reset(world.human_end),
        robot_end=world.since_reset(world.robot_end),
        human_velocity=world.since_reset(world.human_velocity),
        human_force=world.since_reset(world.human_force),
        robot_force=world.since_reset(world.robot_force),
        target=lift.target[: lift.frame],
        action=np.array(actions, dtype=np.float64).reshape(len(actions), width),
        internals={
            name: np.array([step.get(name, math.nan) for step in internals])
            for name in (internals[0] if internals else {})
        },
    )


def score(lift: Lift, trace: Trace, *, failed: bool) -> Scores:
    """Return the metrics of a trace of the lift's current episode.

    A failed episode keeps the frames it has for force and work; it has no smoothness and no lag.
    """
    human, robot, horizon = trace.human_end, trace.robot_end, lift.horizon
    felt = trace.human_force - WEIGHT_SHARE
    smoothness = functools.partial(metrics.stroke_smoothness, robot, human, lift.plan.strokes)
    empty = len(human) == 0
    return Scores(
        rmse_mm=metrics.rmse_mm(human, robot, horizon=horizon),
        abs_error_mm=metrics.abs_error_mm(human, robot, horizon=horizon),
        max_tilt_deg=math.nan if empty else metrics.max_tilt_deg(human, robot, length=TABLE_LENGTH),
        sparc=math.nan if failed else smoothness(metric=sparc),
        ldlj=math.nan if failed else smoothness(metric=ldlj),
        human_force_n=math.nan if empty else metrics.human_force_n(felt),
        human_work_j=math.nan if empty else metrics.human_work_j(felt, trace.human_velocity),
        robot_lag_ms=math.nan if failed else metrics.robot_lag_ms(human, robot),
        short_of_goal_mm=1000 * (lift.plan.goal - float(human.max(initial=0.0))),
    )
