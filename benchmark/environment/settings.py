"""Spaces and settings that the views of the environment share."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from gymnasium.spaces import Box

from ...agents.actions import action_limit
from ...agents.agent import FRAME, HumanObservation, RobotObservation
from ...agents.errors import InputError
from ..episode.lift import REFERENCE_RANGE
from ..episode.scenario import LONGEST_PERIOD

SETTINGS: Final = ("scenario", "subject", "partner", "control_period", "latency", "render_mode")
"""What an environment is made with, and keeps."""

HEIGHT_BOUND: Final = 2.0
"""Bound of every height in an observation [m]; a lift stays far inside it."""

VELOCITY_BOUND: Final = 50.0
FORCE_BOUND: Final = 1e4

LONGEST_EPISODE: Final = 120.0
"""Bound of the time in an observation [s]."""


def robot_action_space(control_period: float) -> Box:
    """Return the robot's actions: the change of its hand command in one period [m]."""
    limit = action_limit(control_period)
    return Box(-limit, limit, (1,), np.float64)


def human_action_space(frames: int) -> Box:
    """Return a human's actions: a hand reference for each of the step's frames [m]."""
    return Box(*REFERENCE_RANGE, (frames,), np.float64)


def robot_observation_space() -> Box:
    """Return the robot's observations, laid out as :class:`.RobotObservation`."""
    bound = np.full(len(RobotObservation), HEIGHT_BOUND)
    low = -bound
    bound[RobotObservation.TIME] = LONGEST_EPISODE + LONGEST_PERIOD
    low[RobotObservation.TIME] = 0.0
    return Box(low, bound, dtype=np.float64)


def human_observation_space(frames: int) -> Box:
    """Return a human's observations, laid out as :class:`.HumanObservation`."""
    bound = np.full(HumanObservation.size(frames), HEIGHT_BOUND)
    bound[HumanObservation.OWN_VELOCITY] = VELOCITY_BOUND
    bound[HumanObservation.HAND_FORCE] = FORCE_BOUND
    low = -bound
    bound[HumanObservation.TIME] = LONGEST_EPISODE + FRAME
    low[HumanObservation.TIME] = 0.0
    return Box(low, bound, dtype=np.float64)


def check_names(**names: object) -> None:
    """Raise an InputError if a setting that is a name is anything but a string."""
    for setting, value in names.items():
        if not isinstance(value, str):
            raise InputError(f"{setting} must be one name, a string, got {value!r}")


def check_times(**times: object) -> None:
    """Raise an InputError if a setting that is a time [s] is no number."""
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
        Whether options that name no setting are let pass: PettingZoo's own tests give some.
    """
    for name in options or {}:
        if name in SETTINGS:
            raise InputError(f"reset cannot change {name}: it is settled when the lift is made")
        if not others:
            raise InputError(f"unknown option {name!r}: reset takes no options")
