"""A motion-capture system as a stream of the Lab Streaming Layer, for ``colift nao``."""

import math

from pylsl import StreamInfo, StreamOutlet, cf_double64, local_clock

MARKERS = ("H1", "H2", "R1", "R2")


def next_frame():
    """Wait for a frame; return (x, y, z) by marker, None if not seen, and the system's latency [s].

    Put the client of your system here.
    """
    raise NotImplementedError


info = StreamInfo("table", "MoCap", 3 * len(MARKERS), 100, cf_double64, "my-vicon")
channels = info.desc().append_child("channels")
for marker in MARKERS:
    for axis in "XYZ":
        channel = channels.append_child("channel")
        channel.append_child_value("label", f"{marker}_{axis}")
        channel.append_child_value("marker", marker)
        channel.append_child_value("type", f"Position{axis}")
        channel.append_child_value("unit", "millimeters")
outlet = StreamOutlet(info)
while True:
    positions, latency = next_frame()
    row = [value for marker in MARKERS for value in positions[marker] or 3 * [math.nan]]
    outlet.push_sample(row, local_clock() - latency)
