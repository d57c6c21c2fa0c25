"""The trace of an episode, frame by frame."""

import dataclasses
import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Final, Self

import numpy as np
from numpy.typing import NDArray

Series = NDArray[np.float64]

ADDED: Final = "task/"
"""Prefix of the names of a task's own series, in files and messages."""

BY_STEP: Final = ("action", "human_action")
"""The series with a row per step; the others have a number per frame."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Trace:
    """The record from which an episode's scores are computed; n frames at 100 Hz, m steps.

    A failed episode ends early: n is then shorter than the horizon.
    """

    human_end: Series
    """(n,) height of the human's table end [m]."""
    robot_end: Series
    """(n,) height of the robot's table end [m]."""
    human_velocity: Series
    """(n,) vertical velocity of the human's table end [m/s]."""
    human_force: Series
    """(n,) force of the human's hands on the table [N], upwards positive."""
    robot_force: Series
    """(n,) force of the robot's hands on the table [N], upwards positive."""
    target: Series
    """(n,) the human's intended height [m]."""
    action: Series
    """(m, k) the actions of the robot's end as given: for a NAO, changes of the command [m]."""
    human_action: Series
    """(m, k) the actions of the human's end as given: hand references [m]."""
    state: NDArray[np.uint8]
    """(m, 16) a hash of all actions and states up to each step; see :mod:`.recorder`."""
    added: Mapping[str, Series] = field(default_factory=dict)
    """(n,) each: the series that the task adds; see :meth:`.Task.series`."""
    internals: Mapping[str, Series] = field(default_factory=dict)
    """(m,) each: the policy's explanation of its actions, if it gives one; see
    :class:`colift.agents.agent.Explaining`."""

    @staticmethod
    def series() -> tuple[str, ...]:
        """Return the names of the fields that are measured series, in order."""
        others = ("state", "added", "internals")
        return tuple(each.name for each in fields(Trace) if each.name not in others)

    def by_frame(self) -> dict[str, Series]:
        """Return the series with one number per frame by name, with those that the task adds."""
        own = {name: getattr(self, name) for name in self.series() if name not in BY_STEP}
        return {**own, **{f"{ADDED}{name}": series for name, series in self.added.items()}}

    def until(self, step: int) -> Self:
        """Return the trace up to a step."""
        frame = step * self.human_action.shape[1]
        cut: dict[str, Any] = {
            name: getattr(self, name)[: step if name in BY_STEP else frame]
            for name in self.series()
        }
        added = {name: series[:frame] for name, series in self.added.items()}
        internals = {name: series[:step] for name, series in self.internals.items()}
        return dataclasses.replace(
            self, **cut, state=self.state[:step], added=added, internals=internals
        )

    def digest(self) -> str:
        """Return the SHA-256 of all numbers: equal if and only if every bit is."""
        sha = hashlib.sha256()
        arrays = {name: getattr(self, name) for name in self.series()}
        arrays |= {f"{ADDED}{name}": self.added[name] for name in sorted(self.added)}
        arrays |= {f"internals/{name}": self.internals[name] for name in sorted(self.internals)}
        for name, array in arrays.items():
            values = np.ascontiguousarray(array, dtype="<f8")
            sha.update(f"{name}{values.shape}".encode())
            sha.update(values.tobytes())
        sha.update(self.state.tobytes())
        return sha.hexdigest()
