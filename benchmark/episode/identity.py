"""The declared numbers and the code that can change a score."""

import dataclasses
import functools
import hashlib
import sys
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final

import numpy as np
from colift.agents import calibration, senses
from colift.agents.actions import HAND_SPEED
from colift.agents.agent import FRAME, HISTORY, RobotObservation
from colift.agents.calibration import CALIBRATION
from colift.agents.humans import (
    PARTNER_SUBJECT,
    ChangingGoal,
    Jerky,
    Partner,
    Pause,
    Recorded,
    Smooth,
)
from colift.agents.identity import Root, code_hash
from colift.agents.registry import HUMANS, TASKS, lookup, own_entries
from colift.benchmark.episode import drops, level_metrics, metrics, seat, smoothness
from colift.benchmark.episode.episode import run_episode
from colift.benchmark.episode.kept_world import lift_in_kept_world
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.metric import Metrics
from colift.benchmark.episode.recorder import Recorder
from colift.benchmark.world import HISTORY_FRAMES, PHYSICS, SERVO, human_body, table
from colift.robots.nao.kinematics import STROKE

SIMULATES: Final[tuple[Root, ...]] = (Lift, Recorder, Partner, lift_in_kept_world)
"""The code from a plan and actions to a trace; the last entry includes the world of a level
table."""

PLANS: Final[tuple[Root, ...]] = (Smooth, Pause, Jerky, ChangingGoal, Recorded)
"""The code from a seed to a human's plan."""

PLAYS_AND_SCORES: Final[tuple[Root, ...]] = (*SIMULATES, RobotObservation, run_episode)
"""The code from a plan and a policy to the scores of an episode."""

STATED: Final[tuple[Root, ...]] = (
    (calibration, "CALIBRATION"),
    (level_metrics, "LEVEL_METRICS"),
)
"""Definitions that the code uses, but that the digest states elsewhere or not at all: subjects are
in the scenarios; the presentation of metrics changes no score, and their limits are among the
numbers."""


def numbers() -> Mapping[str, Any]:
    """Return the numbers that change a score, by names that do not depend on the code."""
    return MappingProxyType(
        {
            "physics": PHYSICS,
            "servo": SERVO,
            "time": {"frame_s": FRAME, "seen_frames": HISTORY},
            "sensors": {"noise_m": senses.MOCAP_NOISE},
            "hand": {"speed_m_s": HAND_SPEED, "stroke_m": STROKE},
            "drop": {
                "tilt_rad": drops.DROP_TILT,
                "force_n": drops.GRIP_FORCE,
                "gap_m": drops.GRIP_GAP,
            },
            "table": {
                "length_m": table.TABLE_LENGTH,
                "mass_kg": table.TABLE_MASS,
                "grip_stiffness_nm_rad": table.GRIP_STIFFNESS,
                "grip_damping_nms_rad": table.GRIP_DAMPING,
                "gravity_m_s2": table.GRAVITY,
            },
            "human": {
                "reference_m": seat.REFERENCE_RANGE,
                "reflex_m": human_body.REFLEX_LIMIT,
                "muscle_s": human_body.MUSCLE_TIME,
                "history_frames": HISTORY_FRAMES,
            },
            "second_human": {"subject": PARTNER_SUBJECT, "lag_s": CALIBRATION.partner_lag},
            "metrics": {
                "failed_frame_mm": metrics.FAILED_FRAME_MM,
                "stroke_tail_s": metrics.STROKE_TAIL,
                "least_motion_m": metrics.MIN_MOTION,
                "least_share": metrics.MIN_SHARE,
                "lag_s": (metrics.MIN_LAG, metrics.MAX_LAG),
                "reached_m": _limits(level_metrics.LEVEL_METRICS)["short_of_goal_mm"] / 1000,
                "least_speed_m_s": smoothness.MIN_PEAK_SPEED,
                "least_samples": smoothness.MIN_SAMPLES,
            },
        }
    )


@functools.cache
def simulation_hash() -> str:
    """Return the hash of the code that simulates, with all tasks and behaviours of colift."""
    tasks, humans = ([lookup(each, name) for name in own_entries(each)] for each in (TASKS, HUMANS))
    stated = (*STATED, *(root for task in tasks for root in _metrics(task)))
    return code_hash(*SIMULATES, *PLANS, *tasks, *humans, without=stated)


@functools.cache
def scores_hash() -> str:
    """Return the hash of the code that plays and scores; behaviours enter with their scenarios."""
    return code_hash(*PLAYS_AND_SCORES, without=STATED)


def plain(value: Any) -> Any:
    """Return a JSON-ready description of frozen parameters, and the code of their classes."""
    if dataclasses.is_dataclass(value):
        fields = {each.name: plain(getattr(value, each.name)) for each in dataclasses.fields(value)}
        kind: type = type(value)
        # The limits of ``level`` are among the numbers.
        limits = _limits(getattr(kind, "metrics", {})) if _metrics(kind) else {}
        stated = {"limits of metrics": limits} if limits else {}
        return {"": code_hash(kind, without=(*STATED, *_metrics(kind))), **stated, **fields}
    if isinstance(value, Mapping):
        return {name: plain(each) for name, each in value.items()}
    if isinstance(value, np.ndarray):
        return hashlib.sha256(np.ascontiguousarray(value, "<f8").tobytes()).hexdigest()
    if isinstance(value, tuple | list):
        return [plain(each) for each in value]
    return value


def _limits(metrics: Metrics) -> dict[str, float]:
    """Return the values of metrics above which a lift has missed its goal."""
    return {name: each.limit for name, each in metrics.items() if each.limit is not None}


@functools.cache
def _metrics(kind: type) -> tuple[Root, ...]:
    """Return the table of metrics of a task's class: their presentation changes no score.

    It is a constant of any module of the package, under one name or several.
    """
    found = getattr(kind, "metrics", None)
    if found is None or found is level_metrics.LEVEL_METRICS:
        return ()
    package = kind.__module__.partition(".")[0]
    return tuple(
        (module, name)
        for module_name, module in sorted(sys.modules.items())
        if module_name.partition(".")[0] == package
        for name, value in vars(module).items()
        if value is found
    )
