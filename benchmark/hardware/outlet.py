"""The emulated motion capture: a real outlet of the Lab Streaming Layer, with four markers."""

from collections import deque
from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from ...agents.agent import FRAME
from ...agents.hardware.missing import load
from ...robots.arm_kinematics import GRIP_X, REST_Z
from ...robots.nao_facts import TORSO_HEIGHT
from ..lift import MOCAP_NOISE
from ..seeding import derive_seed
from ..world.table import TABLE_LENGTH
from .faults import Fault

MARKERS: Final = {
    "H1": (GRIP_X + TABLE_LENGTH, 0.2),
    "H2": (GRIP_X + TABLE_LENGTH, -0.2),
    "R1": (GRIP_X, 0.2),
    "R2": (GRIP_X, -0.2),
}
"""Where each marker is on the table at rest: x and y in the robot's frame [m]."""

REST_HEIGHT: Final = TORSO_HEIGHT + REST_Z
"""Height of the table at rest above the floor [m]."""

MARKER_NOISE: Final = MOCAP_NOISE * 2**0.5
"""Standard deviation of a coordinate [m]: the mean of an end's two markers is as noisy as the
simulated motion capture."""


class Outlet:
    """Sends the table's markers, and makes of it what the faults ask for.

    Parameters
    ----------
    name
        The stream's name.
    latency
        How long the system takes from a frame to its sending [s].
    """

    def __init__(self, name: str, latency: float) -> None:
        self._lsl = lsl = load("pylsl")
        info = lsl.StreamInfo(
            name, "MoCap", 3 * len(MARKERS), 1 / FRAME, lsl.cf_double64, f"colift-emulator-{name}"
        )
        channels = info.desc().append_child("channels")
        for marker in MARKERS:
            for axis in "XYZ":
                channel = channels.append_child("channel")
                channel.append_child_value("label", f"{marker}_{axis}")
                channel.append_child_value("marker", marker)
                channel.append_child_value("type", f"Position{axis}")
                channel.append_child_value("unit", "meters")
        self._outlet: Any = lsl.StreamOutlet(info)
        self._latency = latency
        self._rng = np.random.default_rng(derive_seed(0, "hardware/markers"))
        self._waiting: deque[tuple[float, float, list[float]]] = deque()
        self._due = 0.0

    def frame(
        self, human_end: float, robot_end: float, faults: Sequence[Fault], since: float
    ) -> None:
        """Capture a frame now, and send what is due.

        Parameters
        ----------
        human_end, robot_end
            Heights of the table's ends [m].
        faults
            Those that are active.
        since
            Time since the first lift was begun [s].
        """
        now = self._lsl.local_clock()
        active = {fault.kind: fault for fault in faults}
        if "stream-end" in active:
            self._outlet = None
        if "swap" in active:
            human_end, robot_end = robot_end, human_end
        if "drift" in active:
            drift = active["drift"].value * (since - active["drift"].start)
            human_end, robot_end = human_end + drift, robot_end + drift
        row: list[float] = []
        for (marker, (x, y)), noise in zip(
            MARKERS.items(), self._rng.normal(0.0, MARKER_NOISE, (4, 3)).tolist(), strict=True
        ):
            z = REST_HEIGHT + (human_end if marker.startswith("H") else robot_end)
            row += [x + noise[0], y + noise[1], z + noise[2]]
        if "nan" in active:
            row[:6] = [np.nan] * 6
        delay = self._latency
        if "latency" in active:
            delay += active["latency"].value
        if "jitter" in active:
            delay += float(self._rng.uniform(0.0, active["jitter"].value))
        if "dropout" not in active:
            # A network may hold a frame up, but does not change the order.
            self._due = max(self._due, now + delay)
            self._waiting.append((self._due, now, row))
        while self._waiting and self._waiting[0][0] <= now:
            _, captured, values = self._waiting.popleft()
            if self._outlet is not None:
                self._outlet.push_sample(values, captured)

    def close(self) -> None:
        """Close the stream."""
        self._outlet = None
