"""Validation of actions, and the speed of the hand."""

import math
from typing import Any, Final

import numpy as np

HAND_SPEED: Final = 0.4
"""Fastest change of the hand command [m/s]: the paper's largest action, 4 cm in 100 ms."""


def action_limit(control_period: float) -> float:
    """Return the largest change of the hand command in one control period [m]."""
    return HAND_SPEED * control_period


class ActionError(ValueError):
    """An action that cannot be carried out; its message names the agent and the rule."""


def checked_action(agent: str, action: Any, size: int) -> list[float]:
    """Return an action as a list of finite floats.

    Parameters
    ----------
    agent
        Name of the agent, for the message.
    action
        Any object. A single number need not be in a list.
    size
        Number of values that the action must have.

    Raises
    ------
    ActionError
        If the action is not ``size`` finite numbers.
    """
    try:
        values = np.asarray(action, dtype=np.float64)
    except Exception:  # An object may have any __array__ or __float__.
        values = np.empty(0)
    if action is None or isinstance(action, str | bytes):  # NumPy would convert these.
        values = np.empty(0)
    if size == 1 and values.ndim == 0:
        values = values.reshape(1)
    if values.shape != (size,):
        due = "1 number" if size == 1 else f"{size} numbers"
        raise ActionError(f"{agent}'s action must be {due}, got {_shown(action)}")
    listed: list[float] = values.tolist()
    if not all(map(math.isfinite, listed)):
        raise ActionError(f"{agent}'s action must be finite, got {listed}")
    return listed


def _shown(action: Any) -> str:
    """Return the beginning of an action's text, whatever type it has."""
    try:
        return f"{action!r:.80}"
    except Exception:
        return f"a {type(action).__name__} that cannot be shown"
