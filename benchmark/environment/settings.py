"""Agents, spaces and settings shared by the views of the environment."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.seat import REFERENCE_RANGE
from gymnasium.spaces import Box

HUMAN, ROBOT = "human", "robot"
"""The two agents."""

SETTINGS: Final = (
    "behaviour",
    "subject",
    "partner",
    "control_period",
    "latency",
    "render_mode",
    "reward",
    "task",
)
"""Settings with which an environment is made, and which it keeps."""


def action_space(lift: Lift, agent: str) -> Box:
    """Return an agent's action space: the numbers that its seat needs, in its range [m]."""
    if agent == HUMAN:
        return Box(*REFERENCE_RANGE, (lift.frames_per_step,), np.float64)
    return Box(
        *lift.seat.action_range(lift.scenario.control_period), (lift.partner_size,), np.float64
    )


def observation_space(lift: Lift, agent: str) -> Box:
    """Return an agent's observation space, with the bounds that the task states."""
    if agent == ROBOT and lift.seat.is_robot:
        low, high = lift.task.robot_bounds()
    else:
        low, high = lift.task.human_bounds(lift.frames_per_step)
    return Box(low, high, dtype=np.float64)


def check_names(**names: object) -> None:
    """Raise an InputError if a setting that is a name is not a string."""
    for setting, value in names.items():
        if not isinstance(value, str):
            raise InputError(f"{setting} must be one name, a string, got {value!r}")


def check_times(**times: object) -> None:
    """Raise an InputError if a setting that is a time [s] is not a number."""
    for setting, value in times.items():
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise InputError(f"{setting} must be a number of seconds, got {value!r}")


def check_options(options: Mapping[str, Any] | None, *, others: bool) -> None:
    """Raise an InputError if a reset is given options that would have no effect.

    Parameters
    ----------
    options
        The options of ``reset``.
    others
        Whether options that name no setting are accepted: PettingZoo's own tests give some.
    """
    for name in options or {}:
        if name in SETTINGS:
            raise InputError(
                f"reset cannot change {name}: it is fixed when the environment is made"
            )
        if not others:
            raise InputError(f"unknown option {name!r}: reset takes no options")
