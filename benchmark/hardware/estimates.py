"""Estimates from trials: a laboratory's latency, sag and noise, for the simulated world."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.hardware.loop import DEAD_TIME
from colift.agents.hardware.plausibility import in_order, seen
from colift.agents.hardware.trial_log import LoggedTrial
from colift.base.errors import InputError
from colift.benchmark.world.table import WEIGHT_SHARE
from colift.robots.nao.kinematics import arm_path
from numpy.typing import NDArray

FEWEST: Final = 20
"""Fewest steps and frames from which an estimate is made."""

LONGEST_DELAY: Final = 0.4
"""Longest delay of the hands in the search [s]."""

LOWEST_MOTION: Final = 0.03
"""Least range of the commands from which the delay of the hands can be estimated [m]."""


@dataclass(frozen=True, kw_only=True)
class Estimates:
    """Numbers of a laboratory, each with the world's parameter that it corresponds to."""

    capture_age: float
    """Age of the newest frame when a step begins [s], median: together with the arms' dead time,
    the lowest ``latency`` that can be simulated for this laboratory."""
    latency: float
    """Time from the policy's frame until the hands begin to move [s], median: the ``latency`` of
    these trials."""
    follow_delay: float
    """Delay of the robot's table end behind its commands [s], each a ramp over its period."""
    servo_time: float
    """Time constant of the arms behind their set-points [s]: ``Servo.time``."""
    stiffness: float
    """Torque over displacement of a joint [Nm/rad]: ``Servo.stiffness``; infinite without sag."""
    sag: float
    """Mean distance of the hands below their set-points [m]."""
    capture_noise: float
    """Standard deviation of an end's height [m]: ``MOCAP_NOISE``."""


def estimate_setup(trials: Sequence[LoggedTrial]) -> Estimates:
    """Return the estimates from some trials.

    Raises
    ------
    InputError
        If they are too short, or the robot did not move.
    """
    logs = [trial.log for trial in trials]
    steps = [step for log in logs for step in log.steps]
    if len(steps) < FEWEST:
        raise InputError(f"{len(steps)} steps are too few to estimate from, {FEWEST} are needed")
    seen_steps = [
        (step.sensing_age, log.latency)
        for log in logs
        for step in log.steps
        if math.isfinite(step.sensing_age)
    ]
    ages, wanted = np.array(seen_steps).T
    stiffness, servo_time, sag = _servo(trials)
    return Estimates(
        capture_age=float(np.median(ages)),
        latency=float(np.median(np.maximum(ages + DEAD_TIME, wanted))),
        follow_delay=float(np.median([_delay(trial) for trial in trials])),
        servo_time=servo_time,
        stiffness=stiffness,
        sag=sag,
        capture_noise=float(np.median([_noise(trial) for trial in trials])),
    )


def _noise(trial: LoggedTrial) -> float:
    """Return the noise of a height from its third differences [m], which motion hardly enters.

    They have the variance 20 s^2 for white noise of the variance s^2; the median of their size is
    0.6745 standard deviations, even with a few jumps.
    """
    frames = [sample for sample in in_order(trial.log.samples) if seen(sample)]
    if len(frames) < FEWEST:
        raise InputError(f"{len(frames)} frames are too few to estimate from")
    differences = np.diff(np.array(frames)[:, 1:], n=3, axis=0)
    return float(np.median(np.abs(differences)) / 0.6745 / math.sqrt(20))


def _ramps(trial: LoggedTrial, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the commanded height at some times [m]: each command a ramp over its period."""
    period = trial.log.period
    knots, heights = [], []
    for step in trial.log.steps:
        given = step.time + step.state_time + step.policy_time
        knots += [given, given + period]
        heights += [step.hand_command, step.command]
    order = np.argsort(knots, kind="stable")
    at: NDArray[np.float64] = np.interp(times, np.array(knots)[order], np.array(heights)[order])
    return at


def _delay(trial: LoggedTrial) -> float:
    """Return the delay [s] at which the robot's end fits its commands best, up to an offset."""
    frames = np.array([s for s in in_order(trial.log.samples) if seen(s)])
    commands = [step.command for step in trial.log.steps]
    if not commands or np.ptp(commands) < LOWEST_MOTION:
        raise InputError(
            f"the hands were commanded to move by less than {1000 * LOWEST_MOTION:.0f} mm: "
            "too little to estimate how they follow"
        )
    first = trial.log.start + LONGEST_DELAY
    frames = frames[frames[:, 0] >= first]
    delays = np.arange(0.0, LONGEST_DELAY, 0.001)
    misfits = [
        float(np.std(frames[:, 2] - _ramps(trial, frames[:, 0] - delay))) for delay in delays
    ]
    return float(delays[int(np.argmin(misfits))])


def _servo(trials: Sequence[LoggedTrial]) -> tuple[float, float, float]:
    """Return stiffness [Nm/rad], time constant [s] and mean sag [m] of the arms.

    A set-point s at height h, moving at v, is ahead of the hands by

        s - h = C(h) / k + T v,    C(h) = sum_i J_i (J_i W / 2 - g_i),

    with the levers J and gravity torques g of the arm path, and half the table's weight W: solved
    for 1/k and T by least squares over all steps.
    """
    path = arm_path()
    rows, ahead = [], []
    for trial in trials:
        steps = trial.log.steps
        times = np.array([step.time for step in steps])
        heights = np.array([step.hand_height for step in steps])
        set_points = np.array([step.set_point for step in steps]) + trial.weight_offset
        if len(steps) < FEWEST:
            continue
        speeds = np.gradient(heights, times)
        for height, set_point, speed in zip(heights, set_points, speeds, strict=True):
            lever, torque = path.lever(float(height)), path.gravity_torque(float(height))
            rows.append((float(lever @ (lever * WEIGHT_SHARE / 2 - torque)), float(speed)))
            ahead.append(float(set_point - height))
    if not rows:
        raise InputError(f"every trial has fewer than {FEWEST} steps: too few to estimate from")
    (compliance, time), *_ = np.linalg.lstsq(np.array(rows), np.array(ahead), rcond=None)
    stiffness = 1 / float(compliance) if compliance > 1e-6 else math.inf
    return stiffness, float(time), float(np.mean(ahead))
