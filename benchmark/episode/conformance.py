"""Rules of tasks, behaviours and episodes; each function returns the first broken one, in words."""

import math
from collections.abc import Mapping
from typing import Any, cast

import numpy as np
from colift.agents.agent import Observation
from colift.agents.humans import Behaviour, Plan, Subject
from colift.base.plugins import article, error_at, object_fault
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import LEADING, Metric, Metrics, Scores
from colift.benchmark.episode.task import Bounds, Task


def behaviour_fault(behaviour: object) -> str | None:
    """Return the reason why an object is not a behaviour, or None; its plans are not tried."""
    return object_fault(behaviour, Behaviour)


def plan_fault(behaviour: Behaviour, subject: Subject, seed: int) -> str | None:
    """Return the reason why a behaviour has no plan for a subject and a seed, or None."""
    try:
        plan: object = behaviour.plan(subject, seed)
    except Exception as error:
        return f"raised {error_at(error, type(behaviour))}"
    if not isinstance(plan, Plan):
        return f"returned {article(plan)}; it must return colift.agents.humans.Plan"
    if not isinstance(plan.target, np.ndarray) or plan.target.ndim != 1 or not len(plan.target):
        return "returned a plan whose target is not a series of heights, (n,)"
    if not np.isfinite(plan.target).all():
        frame = int(np.isfinite(plan.target).argmin())
        return f"returned a plan whose target is {plan.target[frame]} in frame {frame}"
    return None


def task_fault(task: object) -> str | None:
    """Return the reason why an object is not a task, or None; no lift is played with it."""
    fault = object_fault(task, Task)
    if fault is not None:
        return fault
    metrics: object = cast(Task, task).metrics
    if not isinstance(metrics, Mapping) or not all(
        isinstance(each, Metric) and each.name == name for name, each in metrics.items()
    ):
        return "must have metrics by their names: see metric_table()"
    first = next(iter(metrics), None)
    return None if first == LEADING else f"must have {LEADING} as its first metric, got {first}"


def observation_fault(lift: Lift) -> str | None:
    """Return the fault of the present observations of a lift, or None."""
    task, frames = lift.task, lift.frames_per_step
    holder = "robot" if lift.seat.is_robot else "second_person"
    bounds = task.robot_bounds() if lift.seat.is_robot else task.human_bounds(frames)
    return _view_fault(holder, lift.partner_observation(), bounds) or _view_fault(
        "human", lift.human_observation(), task.human_bounds(frames)
    )


def _view_fault(agent: str, view: Observation, bounds: Bounds) -> str | None:
    what = f"{agent}_observation()"
    stated = "robot_bounds()" if agent == "robot" else "human_bounds()"
    low, high = bounds
    if not isinstance(view, np.ndarray):
        return f"{what} returned {article(view)}; it must be an array"
    if np.shape(low) != np.shape(high):
        return f"{stated} has {_size(low)} lowest and {_size(high)} highest values"
    if view.shape != np.shape(low):
        return f"{what} has {_size(view)} numbers, {stated} has {_size(low)}"
    inside = (low <= view) & (view <= high)
    if not inside.all():
        index = int(inside.argmin())
        return (
            f"{what} is {view[index]:g} at index {index}, outside its bounds, "
            f"{low[index]:g} to {high[index]:g}"
        )
    return None


def _size(array: Observation) -> str:
    return " x ".join(map(str, np.shape(array)))


def rewards_fault(lift: Lift) -> str | None:
    """Return the fault of the rewards of the step just made, or None."""
    rewards: object = lift.task.rewards(lift)
    if np.shape(cast(Any, rewards)) != (2,) or not np.isfinite(cast(Any, rewards)).all():
        return f"rewards() returned {rewards!r:.80}; it must return two finite numbers"
    return None


def episode_fault(metrics: Metrics, episode: Episode) -> str | None:
    """Return the fault of a task's outcome of an episode, or None."""
    failure: object = episode.failure
    if failure is not None and not (isinstance(failure, str) and failure):
        return f"failure() returned {failure!r:.80}; it must return a reason or None"
    frames = len(episode.trace.human_end)
    for name, series in episode.trace.added.items():
        if np.shape(series) != (frames,):
            return (
                f"series() returned {name} of shape {np.shape(series)}; it must have one number "
                f"per frame, ({frames},)"
            )
    return scores_fault(metrics, episode.scores)


def scores_fault(metrics: Metrics, scores: Scores) -> str | None:
    """Return the fault of the scores of an episode, or None."""
    missing = [name for name in metrics if name not in scores]
    surplus = [str(name) for name in scores if name not in metrics]
    if missing or surplus:
        parts = []
        if missing:
            parts.append(f"lacks {', '.join(missing)}")
        if surplus:
            parts.append(f"has the surplus {', '.join(surplus)}")
        return f"score() {' and '.join(parts)}; it must return one number for each metric"
    for name, metric in metrics.items():
        value: object = scores[name]
        if not isinstance(value, float | int):
            return f"score() returned {name} as {article(value)}; it must be a float"
        if math.isinf(value):
            return f"score() returned {name} = {value}; it must be finite, or NaN if it is missing"
        if math.isnan(value) and (metric.missing == "never" or name == LEADING):
            return f"score() returned {name} = nan, but it is stated never to be missing"
    return None
