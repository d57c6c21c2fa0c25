"""Motion capture of the table from a stream of the Lab Streaming Layer.

The stream has channels for the positions of markers, labelled by the layer's convention for motion
capture: one channel per coordinate, with ``marker`` (or a label ``NAME_X``), ``type``
(``PositionZ``) and ``unit``.
"""

from dataclasses import dataclass
from typing import Any, Final

from colift.agents.hardware.clocks import awake_or_asleep
from colift.agents.hardware.ends import Height, MarkerEnds
from colift.agents.hardware.missing import import_optional
from colift.agents.hardware.ports import CaptureLostError, Sample
from colift.base.errors import InputError

RESOLVE_TIME: Final = 1.0
"""Duration of a search for streams [s]: all that answer in this time are found."""

SEARCHES: Final = 3
"""Number of searches after which a stream counts as missing."""

ANSWER_TIME: Final = 3.0
"""Longest time for a stream's description, and to open it [s]."""

UNITS: Final = {
    "m": 1.0, "meter": 1.0, "meters": 1.0, "metres": 1.0,
    "mm": 0.001, "millimeter": 0.001, "millimeters": 0.001, "millimetres": 0.001,
}  # fmt: skip
"""Metres per unit."""


@dataclass(frozen=True, kw_only=True)
class Layout:
    """Markers and vertical axis of the table in a stream.

    Raises
    ------
    InputError
        If a marker is named twice.
    """

    human: tuple[str, ...] = ("H1", "H2")
    """Markers at the human's end."""
    robot: tuple[str, ...] = ("R1", "R2")
    """Markers at the robot's end."""
    up: str = "Z"
    """The axis that points up: Z of a Vicon, usually Y of an OptiTrack."""

    def __post_init__(self) -> None:
        """Check the markers."""
        markers = [*self.human, *self.robot]
        twice = dict.fromkeys(marker for marker in markers if markers.count(marker) > 1)
        if twice:
            raise InputError(f"markers named more than once: {', '.join(twice)}")


class LslCapture:
    """A stream of the Lab Streaming Layer as :class:`.MotionCapture`.

    Time stamps are brought to this machine's monotonic clock by the layer's own synchronisation.

    Parameters
    ----------
    name
        The stream, see :func:`find_stream`.
    layout
        Markers and vertical axis of the table.

    Raises
    ------
    InputError
        If there is no such stream or more than one, it lacks a marker or a unit, or pylsl is not
        installed.
    """

    def __init__(self, name: str, layout: Layout) -> None:
        lsl = import_optional("pylsl")
        self._lsl = lsl
        # To recover would be to go on with any stream of the same name and source id.
        self._inlet = lsl.StreamInlet(
            find_stream(lsl, name), max_buflen=2, processing_flags=lsl.proc_clocksync, recover=False
        )
        info = self._inlet.info(timeout=ANSWER_TIME)
        channels = list_channels(info)
        self._ends = MarkerEnds(
            [pick_channel(channels, marker, layout.up) for marker in layout.human],
            [pick_channel(channels, marker, layout.up) for marker in layout.robot],
        )
        self._inlet.open_stream(timeout=ANSWER_TIME)
        self.info: dict[str, object] = {
            "name": info.name(),
            "type": info.type(),
            "host": info.hostname(),
            "source_id": info.source_id(),
            "channels": info.channel_count(),
            "rate_hz": info.nominal_srate(),
            "clock_offset_s": self._inlet.time_correction(timeout=ANSWER_TIME),
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
        shift = awake_or_asleep() - self._lsl.local_clock()
        return [
            self._ends.sample(stamp + shift, row) for row, stamp in zip(rows, stamps, strict=True)
        ]

    def close(self) -> None:
        """Close the stream."""
        self._inlet.close_stream()


def find_stream(lsl: Any, place: str) -> Any:
    """Return the only stream of a name on the network.

    Parameters
    ----------
    lsl
        The module ``pylsl``.
    place
        ``NAME`` or ``NAME@HOST``; the host of a stream's sender, or its source id.

    Raises
    ------
    InputError
        If there is no such stream, or more than one.
    """
    for _ in range(SEARCHES):
        streams = lsl.resolve_streams(RESOLVE_TIME)
        found = [stream for stream in streams if place in addresses(stream)]
        if found:
            break
    else:
        known = ", ".join(sorted({_described(stream) for stream in streams}))
        raise InputError(
            f"no stream {place!r} on the network within {SEARCHES * RESOLVE_TIME:g} s; found: "
            f"{known or 'none'}. If multicast does not get through, name the sender "
            "in lsl_api.cfg (docs/guides/capture.md)"
        )
    if len(found) == 1:
        return found[0]
    alike = "; ".join(sorted(_described(stream) for stream in found))
    # An address that only one of them has.
    known_addresses = [address for stream in found for address in addresses(stream)]
    choices = sorted(address for address in known_addresses if known_addresses.count(address) == 1)
    cure = f"choose one, such as lsl:{choices[0]}" if choices else "end all but one"
    raise InputError(f"{len(found)} streams are called {place!r}: {alike}; {cure}")


def addresses(stream: Any) -> list[str]:
    """Return the texts that stand for a stream: its name, alone and with host or source id."""
    name, host, source = stream.name(), stream.hostname(), stream.source_id()
    return list(dict.fromkeys([name, f"{name}@{host}", *([f"{name}@{source}"] * bool(source))]))


def _described(stream: Any) -> str:
    return f"{stream.name()} of {stream.hostname()} (source id {stream.source_id() or 'none'})"


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
        If there is no such channel or more than one, or its unit is unknown.
    """
    found = [each for each in channels if each.marker == marker and each.axis == axis.upper()]
    if not found:
        known = ", ".join(dict.fromkeys(channel.marker for channel in channels if channel.marker))
        raise InputError(
            f"the stream has no {axis} of marker {marker!r}; markers: {known or 'none'}"
        )
    if len(found) > 1:
        numbers = ", ".join(str(each.index + 1) for each in found)
        raise InputError(
            f"the stream has {len(found)} channels for {axis} of marker {marker!r}, numbers "
            f"{numbers}: give each marker a name of its own"
        )
    (channel,) = found
    if channel.unit.lower() not in UNITS:
        raise InputError(
            f"marker {marker} has the unit {channel.unit!r}; known: {', '.join(UNITS)}"
        )
    return Height(marker, channel.index, UNITS[channel.unit.lower()])
