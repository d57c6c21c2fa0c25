"""The trace of an episode: what happened, frame by frame."""

import dataclasses
import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

Series = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Trace:
    """Everything that an episode's scores are computed from; n frames at 100 Hz, m steps.

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
    """(n,) the same of the robot's hands [N]."""
    target: Series
    """(n,) the human's intended height [m]."""
    action: Series
    """(m, k) the actions of the robot's end as given: of a NAO, changes of the command [m]."""
    human_action: Series
    """(m, k) the actions of the human's end as given: hand references [m]."""
    state: NDArray[np.uint8]
    """(m, 16) a hash of all actions and states up to each step; see :mod:`.recorder`."""
    internals: Mapping[str, Series] = field(default_factory=dict)
    """(m,) each: what the policy says its actions were based on, where it says so; see
    :class:`colift.agents.agent.Explaining`."""

    @staticmethod
    def series() -> tuple[str, ...]:
        """Return the names of the fields that are measured series, in order."""
        return tuple(each.name for each in fields(Trace) if each.name not in ("state", "internals"))

    def until(self, step: int) -> Self:
        """Return the trace of what happened before a step."""
        frame = step * self.human_action.shape[1]
        by_step = ("action", "human_action", "state")
        cut: dict[str, Any] = {
            name: getattr(self, name)[: step if name in by_step else frame]
            for name in (*self.series(), "state")
        }
        internals = {name: series[:step] for name, series in self.internals.items()}
        return dataclasses.replace(self, **cut, internals=internals)

    def digest(self) -> str:
        """Return the SHA-256 of all numbers: equal if and only if every bit is."""
        sha = hashlib.sha256()
        arrays = {name: getattr(self, name) for name in self.series()}
        arrays |= {f"internals/{name}": self.internals[name] for name in sorted(self.internals)}
        for name, array in arrays.items():
            values = np.ascontiguousarray(array, dtype="<f8")
            sha.update(f"{name}{values.shape}".encode())
            sha.update(values.tobytes())
        sha.update(self.state.tobytes())
        return sha.hexdigest()
