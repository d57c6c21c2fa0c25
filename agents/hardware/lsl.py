"""Motion capture of the table from a stream of the Lab Streaming Layer.

The stream has channels for the positions of markers, labelled by the layer's convention for motion
capture: one channel per coordinate, with ``marker`` (or a label ``NAME_X``), ``type``
(``PositionZ``) and ``unit``.
"""

import time
from dataclasses import dataclass
from typing import Any, Final

from ..errors import InputError
from .ends import Height, MarkerEnds
from .missing import import_optional
from .ports import CaptureLostError, Sample

RESOLVE_TIME: Final = 3.0
"""Longest search for a stream [s]."""

UNITS: Final = {
    "m": 1.0, "meter": 1.0, "meters": 1.0, "metres": 1.0,
    "mm": 0.001, "millimeter": 0.001, "millimeters": 0.001, "millimetres": 0.001,
}  # fmt: skip
"""Metres per unit."""


@dataclass(frozen=True, kw_only=True)
class Layout:
    """Markers and vertical axis of the table in a stream."""

    human: tuple[str, ...] = ("H1", "H2")
    """Markers at the human's end."""
    robot: tuple[str, ...] = ("R1", "R2")
    """Markers at the robot's end."""
    up: str = "Z"
    """The axis that points up: Z of a Vicon, usually Y of an OptiTrack."""


class LslCapture:
    """A stream of the Lab Streaming Layer as :class:`.MotionCapture`.

    Time stamps are brought to this machine's monotonic clock by the layer's own synchronisation.

    Parameters
    ----------
    name
        The stream's name.
    layout
        Markers and vertical axis of the table.

    Raises
    ------
    InputError
        If there is no such stream, it lacks a marker or a unit, or pylsl is not installed.
    """

    def __init__(self, name: str, layout: Layout) -> None:
        lsl = import_optional("pylsl")
        found = lsl.resolve_byprop("name", name, timeout=RESOLVE_TIME)
        if not found:
            known = sorted({stream.name() for stream in lsl.resolve_streams(0.5)})
            raise InputError(
                f"no stream {name!r} on the network within {RESOLVE_TIME:g} s; found: "
                f"{', '.join(known) or 'none'}. If multicast does not get through, name the sender "
                "in lsl_api.cfg (docs/guides/hardware.md)"
            )
        self._lsl = lsl
        self._inlet = lsl.StreamInlet(
            found[0], max_buflen=2, processing_flags=lsl.proc_clocksync, recover=True
        )
        info = self._inlet.info(timeout=RESOLVE_TIME)
        channels = list_channels(info)
        self._ends = MarkerEnds(
            [pick_channel(channels, marker, layout.up) for marker in layout.human],
            [pick_channel(channels, marker, layout.up) for marker in layout.robot],
        )
        self._inlet.open_stream(timeout=RESOLVE_TIME)
        self.info: dict[str, object] = {
            "name": info.name(),
            "type": info.type(),
            "host": info.hostname(),
            "channels": info.channel_count(),
            "rate_hz": info.nominal_srate(),
            "clock_offset_s": self._inlet.time_correction(timeout=RESOLVE_TIME),
        }
        """The stream's description of itself."""

    def set_rest(self, human_end: float, robot_end: float) -> None:
        """Subtract these heights [m] from the ends' heights."""
        self._ends.set_rest(human_end, robot_end)

    @property
    def unseen(self) -> str:
        """Markers not seen in the newest frame, with the reason; empty if all were seen."""
        return self._ends.unseen

    def drain(self) -> list[Sample]:
        """Return the frames received since the last call, oldest first."""
        try:
            rows, stamps = self._inlet.pull_chunk(timeout=0.0, max_samples=1024)
        except self._lsl.util.LostError as error:
            raise CaptureLostError(f"the stream is lost: {error}") from error
        shift = time.monotonic() - self._lsl.local_clock()
        return [
            self._ends.sample(stamp + shift, row) for row, stamp in zip(rows, stamps, strict=True)
        ]

    def close(self) -> None:
        """Close the stream."""
        self._inlet.close_stream()


@dataclass(frozen=True, kw_only=True)
class StreamChannel:
    """One coordinate of one marker."""

    index: int
    marker: str
    axis: str
    """``X``, ``Y``, ``Z``, or something else."""
    unit: str


def list_channels(info: Any) -> list[StreamChannel]:
    """Return the channels that a stream's information describes."""
    found = []
    node = info.desc().child("channels").child("channel")
    for index in range(info.channel_count()):
        label, kind = node.child_value("label"), node.child_value("type")
        marker, _, axis = label.rpartition("_")
        found.append(
            StreamChannel(
                index=index,
                marker=node.child_value("marker") or marker,
                axis=(kind.removeprefix("Position") or axis).upper(),
                unit=node.child_value("unit"),
            )
        )
        node = node.next_sibling("channel")
    return found


def pick_channel(channels: list[StreamChannel], marker: str, axis: str) -> Height:
    """Return the place of a marker's coordinate in a row, and its metres per unit.

    Raises
    ------
    InputError
        If there is no such channel, or its unit is unknown.
    """
    for channel in channels:
        if channel.marker == marker and channel.axis == axis.upper():
            if channel.unit.lower() not in UNITS:
                raise InputError(
                    f"marker {marker} has the unit {channel.unit!r}; known: {', '.join(UNITS)}"
                )
            return Height(marker, channel.index, UNITS[channel.unit.lower()])
    known = ", ".join(dict.fromkeys(channel.marker for channel in channels if channel.marker))
    raise InputError(f"the stream has no {axis} of marker {marker!r}; markers: {known or 'none'}")
