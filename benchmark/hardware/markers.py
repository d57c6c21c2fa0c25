"""The emulated motion capture: four markers on the table, and the effects of faults on them."""

import bisect
from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np
from colift.agents.senses import MOCAP_NOISE
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.hardware.faults import Fault
from colift.benchmark.world.table import TABLE_LENGTH
from colift.robots.nao.facts import TORSO_HEIGHT
from colift.robots.nao.kinematics import GRIP_X, REST_Z

MARKERS: Final = {
    "H1": (GRIP_X + TABLE_LENGTH, 0.2),
    "H2": (GRIP_X + TABLE_LENGTH, -0.2),
    "R1": (GRIP_X, 0.2),
    "R2": (GRIP_X, -0.2),
}
"""Place of each marker on the table at rest: x and y in the robot's frame [m]."""

REST_HEIGHT: Final = TORSO_HEIGHT + REST_Z
"""Height of the table at rest above the floor [m]."""

MARKER_NOISE: Final = MOCAP_NOISE * 2**0.5
"""Standard deviation of a coordinate [m]: the mean of an end's two markers is as noisy as the
simulated motion capture."""

Row = tuple[float, list[float]]
"""Time stamp of a frame [s], and x, y and z of each marker [m]."""


class Markers:
    """Captures the table frame by frame, and releases each frame when it is due.

    Parameters
    ----------
    latency
        Time from a frame to its sending [s].
    """

    def __init__(self, latency: float) -> None:
        self._latency = latency
        self._rng = np.random.default_rng(derive_seed(0, "hardware/markers"))
        self._waiting: list[tuple[float, Row]] = []
        self._due = 0.0
        self._frames = 0
        self._heights: list[float] = []

    def capture(
        self, now: float, human_end: float, robot_end: float, faults: Sequence[Fault]
    ) -> None:
        """Capture a frame.

        Parameters
        ----------
        now
            The time [s].
        human_end, robot_end
            Heights of the table's ends [m].
        faults
            The active faults.
        """
        active = {fault.kind: fault for fault in faults}
        if "swap" in active:
            human_end, robot_end = robot_end, human_end
        if "drift" in active:
            drift = active["drift"].value * (now - active["drift"].start)
            human_end, robot_end = human_end + drift, robot_end + drift
        row: list[float] = []
        noises = self._rng.normal(0.0, MARKER_NOISE, (len(MARKERS), 3)).tolist()
        for (marker, (x, y)), noise in zip(MARKERS.items(), noises, strict=True):
            z = REST_HEIGHT + (human_end if marker.startswith("H") else robot_end)
            row += [x + noise[0], y + noise[1], z + noise[2]]
        frozen = round(active["freeze"].value) if "freeze" in active else 0
        row[2 : 3 * frozen : 3] = self._heights[:frozen]
        self._heights = row[2::3]
        if "nan" in active:
            row[:6] = [np.nan] * 6
        if "unit-change" in active:
            row = [1000 * value for value in row]
        stamp = now
        if "future-stamps" in active:
            stamp += active["future-stamps"].value
        if "past-stamps" in active:
            stamp -= active["past-stamps"].value
        if "nan-stamps" in active:
            stamp = np.nan
        delay = self._latency
        if "latency" in active:
            delay += active["latency"].value
        if "jitter" in active:
            delay += float(self._rng.uniform(0.0, active["jitter"].value))
        self._frames += 1
        left_out = "slow" in active and self._frames % round(active["slow"].value)
        if "dropout" in active or left_out or self._happens(active.get("loss")):
            return
        # The layer may delay a frame, but does not change the order; what comes before it may.
        self._due = max(self._due, now + delay)
        due = self._due
        if "reorder" in active:
            due += float(self._rng.uniform(0.0, active["reorder"].value))
        for _ in range(2 if self._happens(active.get("duplicate")) else 1):
            bisect.insort(self._waiting, (due, (stamp, row)), key=lambda each: each[0])

    def _happens(self, fault: Fault | None) -> bool:
        """Return whether a fault hits this frame: its value is the share of those that it hits."""
        return fault is not None and bool(self._rng.uniform() < fault.value)

    def due(self, now: float) -> Iterator[Row]:
        """Yield the frames that are to be sent now, in the order of their sending."""
        while self._waiting and self._waiting[0][0] <= now + 1e-9:
            yield self._waiting.pop(0)[1]
