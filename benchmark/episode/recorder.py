"""Records an episode while it is played."""

import hashlib
import math
import struct
from collections.abc import Mapping, Sequence

import numpy as np
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.trace import Trace
from colift.benchmark.world.interface import since_reset

HASH_BYTES = 16
"""Length of a step's hash: 128 bits."""


class Recorder:
    """Keeps the actions of each step and a hash h of the episode up to it.

        h(k) = BLAKE2b(h(k - 1), actions of step k, state of the world after it), h(-1) empty

    The hash covers the bits of the float64 numbers: two episodes with equal last hashes are equal;
    otherwise the first different hash marks the first different step.

    Parameters
    ----------
    lift
        The lift that is played; it has just been reset.
    """

    def __init__(self, lift: Lift) -> None:
        self._lift = lift
        self._partner: list[Sequence[float]] = []
        self._human: list[Sequence[float]] = []
        self._hashes: list[bytes] = []
        self._internals: list[Mapping[str, float]] = []

    @property
    def steps(self) -> int:
        """Number of recorded steps."""
        return len(self._hashes)

    def step(
        self, human: Sequence[float], partner: Sequence[float], internals: Mapping[str, float]
    ) -> None:
        """Record the step just made: both actions, and the partner's explanation of its own."""
        numbers = (*human, *partner, *self._lift.world.state())
        before = self._hashes[-1] if self._hashes else b""
        message = before + struct.pack(f"<{len(numbers)}d", *numbers)
        self._hashes.append(hashlib.blake2b(message, digest_size=HASH_BYTES).digest())
        self._human.append(human)
        self._partner.append(partner)
        self._internals.append(internals)

    def trace(self) -> Trace:
        """Return the trace so far."""
        lift, world, steps = self._lift, self._lift.world, self.steps
        names = self._internals[0] if self._internals else {}
        return Trace(
            human_end=since_reset(world.human_end),
            robot_end=since_reset(world.robot_end),
            human_velocity=since_reset(world.human_velocity),
            human_force=since_reset(world.human_force),
            robot_force=since_reset(world.robot_force),
            target=lift.target[: lift.frame],
            action=np.array(self._partner, dtype=np.float64).reshape(steps, lift.partner_size),
            human_action=np.array(self._human, dtype=np.float64).reshape(
                steps, lift.frames_per_step
            ),
            state=np.frombuffer(b"".join(self._hashes), np.uint8).reshape(steps, HASH_BYTES),
            added=lift.task.series(lift),
            internals={
                name: np.array([step.get(name, math.nan) for step in self._internals])
                for name in names
            },
        )
