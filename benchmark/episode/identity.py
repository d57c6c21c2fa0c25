"""The code that can change a score, and the parameters of a scenario, for digests."""

import dataclasses
import functools
import hashlib
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from colift.agents.agent import RobotObservation
from colift.agents.calibration import CALIBRATION
from colift.agents.humans import SecondPerson
from colift.base.identity import Root, code_hash
from colift.base.registry import HUMANS, ROBOTS, TASKS, lookup, own_entries
from colift.benchmark.episode.kept_world import lift_in_kept_world
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.recorder import Recorder

SIMULATES: Final[tuple[Root, ...]] = (Lift, Recorder, SecondPerson, lift_in_kept_world)
"""The code from a plan and actions to a trace; the last entry includes the world of a level
table."""

PLAYS_AND_SCORES: Final[tuple[Root, ...]] = (*SIMULATES, RobotObservation, run_episode)
"""The code from a plan and a policy to the scores of an episode."""

STATED: Final = (CALIBRATION,)
"""Values that the code uses, but that the digest states elsewhere or not at all: what is calibrated
is in the scenarios and in fields of classes; the presentation of metrics changes no score, and
their limits are stated with their task."""


@functools.cache
def simulation_hash() -> str:
    """Return the hash of the code that simulates, with all tasks and behaviours of colift."""
    tasks, humans, robots = (
        [lookup(each, name) for name in own_entries(each)] for each in (TASKS, HUMANS, ROBOTS)
    )
    return code_hash(*SIMULATES, *tasks, *humans, *robots, without=stated(), values=True)


@functools.cache
def stated() -> tuple[object, ...]:
    """Return the values that code may use without a digest of it: metrics of tasks, too."""
    return (*STATED, *(lookup(TASKS, name).metrics for name in own_entries(TASKS)))


def scores_hash() -> str:
    """Return the hash of the code that plays and scores; behaviours enter with their scenarios."""
    return code_hash(*PLAYS_AND_SCORES, without=STATED, values=True)


def plain(value: Any) -> Any:
    """Return a JSON-ready description of frozen parameters, and the code of their classes."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = {each.name: plain(getattr(value, each.name)) for each in dataclasses.fields(value)}
        return {"": _code(type(value)), "limits of metrics": _limits(value), **fields}
    if isinstance(value, Mapping):
        return {name: plain(each) for name, each in value.items()}
    if isinstance(value, np.ndarray):
        return hashlib.sha256(np.ascontiguousarray(value, "<f8").tobytes()).hexdigest()
    if isinstance(value, tuple | list):
        return [plain(each) for each in value]
    return value


@functools.cache
def _code(kind: type) -> str:
    metrics = [vars(each)["metrics"] for each in kind.__mro__ if "metrics" in vars(each)]
    return code_hash(kind, without=(*STATED, *metrics), values=True)


def _limits(task: object) -> dict[str, float]:
    """Return the values of a task's metrics above which a lift has missed its goal."""
    metrics = getattr(task, "metrics", {})
    return {name: each.limit for name, each in metrics.items() if each.limit is not None}
