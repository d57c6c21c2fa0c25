"""What an action must be."""

import math
from typing import Any

import numpy as np


class ActionError(ValueError):
    """An action that cannot be carried out; the message says whose, what it is and should be."""


def checked_action(agent: str, action: Any, size: int) -> list[float]:
    """Return an action as a list of finite floats.

    Parameters
    ----------
    agent
        Whose it is, for the message.
    action
        Whatever the agent returned.
    size
        How many numbers it must be.

    Raises
    ------
    ActionError
        If it is anything else than ``size`` finite numbers.
    """
    try:
        values = np.asarray(action, dtype=np.float64)
    except Exception:  # An object may have any __array__ or __float__.
        values = np.empty(0)
    if values.shape != (size,):
        raise ActionError(f"{agent}'s action must be {size} number(s), got {_shown(action)}")
    listed: list[float] = values.tolist()
    if not all(map(math.isfinite, listed)):
        raise ActionError(f"{agent}'s action must be finite, got {listed}")
    return listed


def _shown(action: Any) -> str:
    """Return the beginning of an action's text, whatever it is."""
    try:
        return f"{action!r:.80}"
    except Exception:
        return f"a {type(action).__name__} that cannot be shown"
