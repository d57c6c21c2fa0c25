"""A real outlet of the Lab Streaming Layer, for the emulated motion capture."""

import time
from typing import Any

from ...agents.agent import FRAME
from ...agents.hardware.missing import import_optional
from .markers import MARKERS, Row


class Outlet:
    """Sends the table's markers.

    Parameters
    ----------
    name
        The stream's name.

    Raises
    ------
    InputError
        If pylsl is not installed.
    """

    def __init__(self, name: str) -> None:
        self._lsl = lsl = import_optional("pylsl")
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

    def send(self, row: Row) -> None:
        """Send a frame that was captured at a time of the monotonic clock, if there is a stream."""
        captured, values = row
        if self._outlet is not None:
            shift = self._lsl.local_clock() - time.monotonic()
            self._outlet.push_sample(values, captured + shift)

    def close(self) -> None:
        """Close the stream."""
        self._outlet = None
