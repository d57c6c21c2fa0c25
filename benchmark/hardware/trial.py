"""The episode of a recorded trial, with the metrics of the simulated ones.

Motion capture gives heights, but no forces or intentions: force, work, and the distance to the
intended height have no value. Smoothness and lag are those of the filtered heights; see
:mod:`.strokes`.
"""

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, NamedTuple, cast

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.hardware.plausibility import in_order, seen
from colift.agents.hardware.ports import Sample
from colift.agents.hardware.trial_log import TrialLog
from colift.agents.humans import SUBJECTS, Plan, Subject
from colift.base.errors import InputError
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import Scores
from colift.benchmark.episode.recorder import HASH_BYTES
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.task import Playing
from colift.benchmark.episode.trace import Trace
from colift.benchmark.execution.runner import Run
from colift.benchmark.hardware.strokes import find_strokes, smoothed
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.world.table import TABLE, TABLE_LENGTH, Table
from numpy.typing import NDArray

HARDWARE: Final = "hardware"
"""Name of the behaviour of a person who lifts in a laboratory."""

SHORTEST: Final = 6.0
"""Least duration that is assumed for a stopped trial [s], so that a stop never pays."""


UNKNOWN: Final = ("human_velocity", "human_force", "robot_force", "target")
"""Series of a simulated lift that motion capture does not give, or not exactly."""

FILTERED: Final = ("sparc", "ldlj", "robot_lag_ms")
"""Metrics of the filtered heights, since they are of derivatives."""


@dataclass(frozen=True, kw_only=True)
class Person:
    """A real person, as :class:`colift.agents.humans.Behaviour`: the plan is unknown."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Raise: a person cannot be simulated."""
        raise InputError("a trial on hardware cannot be simulated: nobody knows the person's plan")


def hardware_suite(name: str, person: str, trials: int, *, period: float, latency: float) -> Suite:
    """Return a suite that represents trials in a laboratory: it has a name, but cannot be played.

    Parameters
    ----------
    name
        Name of the set-up, such as a robot and its version.
    person
        Name of the person who lifts.
    trials
        Number of lifts; their seeds are their numbers.
    period, latency
        Control period and latency of the real-time loop [s].

    Raises
    ------
    InputError
        If a time is not a whole number of frames.
    """
    scenario = Scenario(
        behaviour=HARDWARE,
        human=Person(),
        subject=dataclasses.replace(SUBJECTS["S1"], name=person),
        control_period=period,
        latency=latency,
        task=LEVEL,
    )
    return Suite(name=name, scenarios=(scenario,), seeds=tuple(range(trials)))


def episode(log: TrialLog, *, person: str, number: int) -> Episode:
    """Return a trial as an episode.

    Parameters
    ----------
    log
        The trial. A stopped trial has failed, with the reason; as in simulation, its missing frames
        (here up to :data:`SHORTEST`) count with the worst error.
    person
        Name of the person who lifted.
    number
        Number of the lift, from 0.
    """
    trace = _trace(log)
    failed = log.stop is not None
    failure = f"{log.stop.name}: {log.reason}" if log.stop is not None else None
    return Episode(
        behaviour=HARDWARE,
        subject=person,
        trial="",
        seed=number,
        scores=_scores(trace, failed=failed),
        failure=failure,
        trace=trace,
        step_times=tuple(step.policy_time for step in log.steps if not math.isnan(step.action)),
    )


def hardware_run(
    policy: str, digest: str, suite: Suite, episodes: Sequence[Episode], isolation: str
) -> Run:
    """Return the trials as a run."""
    return Run(
        policy=policy,
        policy_digest=digest,
        suite=suite,
        episodes=tuple(episodes),
        isolation=isolation,
    )


def _trace(log: TrialLog) -> Trace:
    """Return the data of the motion capture and the loop, at 100 Hz from the first step."""
    steps = log.steps
    per_step = round(log.period / FRAME)
    stop = steps[-1].deadline + log.period if steps else log.start
    frames = round((stop - log.start) / FRAME)
    human_end, robot_end = _resampled(log, frames)
    missing = np.full(frames, math.nan)
    return Trace(
        human_end=human_end,
        robot_end=robot_end,
        human_velocity=np.gradient(smoothed(human_end), FRAME) if frames > 1 else missing,
        human_force=missing,
        robot_force=missing,
        target=missing,
        action=np.array([[step.action] for step in steps]).reshape(-1, 1),
        human_action=np.full((len(steps), per_step), math.nan),
        state=np.zeros((len(steps), HASH_BYTES), np.uint8),
        internals={
            name: np.array([getattr(step, name) for step in steps], dtype=np.float64)
            for name in ("command", "hand_height", "sensing_age")
        },
    )


def possible(sample: Sample) -> bool:
    """Return whether a frame shows both ends, no further apart than the table is long.

    The frames of a trial that was stopped may show anything.
    """
    return seen(sample) and abs(sample.human_end - sample.robot_end) <= TABLE_LENGTH


def _resampled(log: TrialLog, frames: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return both ends' heights at the ends of frames, linear between those that were captured."""
    samples = list(filter(possible, in_order(log.samples)))
    if not samples or not frames:
        return np.zeros(frames), np.zeros(frames)
    times, human, robot = np.array(samples).T
    wanted = log.start + FRAME * np.arange(1, frames + 1)
    return np.interp(wanted, times, human), np.interp(wanted, times, robot)


class _Unknown(NamedTuple):
    """The intention of a person, of which nothing is known."""


NO_INTENTION: Final = _Unknown()


@dataclass(frozen=True, kw_only=True)
class _Unplanned:
    """What a score may ask of a lift, for a trial: nothing of it is known, except its length."""

    plan: Plan
    horizon: int
    share: float
    table: Table = TABLE
    intention: _Unknown = NO_INTENTION

    def clipped(self, actions: NDArray[np.float64]) -> float:
        return self.share


def _scores(trace: Trace, *, failed: bool) -> Scores:
    """Return the metrics of ``level``; one that motion capture does not give has no value.

    These are found out: what is not known is replaced by noise, twice, and a metric that follows
    from what is known has the same value both times.
    """
    human, robot = smoothed(trace.human_end), smoothed(trace.robot_end)
    failed = failed or not len(human)
    length = max(len(human), round(SHORTEST / FRAME)) if failed else len(human)
    strokes = () if failed else find_strokes(human)
    filtered = dataclasses.replace(trace, human_end=human, robot_end=robot)

    def scored(seed: int) -> Scores:
        noise = np.random.default_rng(seed)
        plan = Plan(target=trace.target, strokes=strokes, goal=noise.normal(), events=())
        lift = cast(Playing, _Unplanned(plan=plan, horizon=length, share=noise.normal()))
        unknown: dict[str, Any] = {name: noise.normal(size=len(human)) for name in UNKNOWN}
        raw, calm = (
            LEVEL.score(lift, dataclasses.replace(each, **unknown), failed=failed)
            for each in (trace, filtered)
        )
        return {**raw, **{name: calm[name] for name in FILTERED}}

    first, second = scored(0), scored(1)
    return {
        name: first[name] if first[name] == second[name] else math.nan for name in LEVEL.metrics
    }
