"""Teleoperation: a policy at the far side of a network, with delayed, jittered, lossy messages.

The names here need no engine: a help text lists the channels.
"""

from colift.benchmark.channels.channel import Channel
from colift.benchmark.channels.named import CHANNELS, channel_name, make_channel
from colift.benchmark.channels.reading import read_channel
from colift.benchmark.links.link import Link

__all__ = [
    "CHANNELS",
    "Channel",
    "Link",
    "channel_name",
    "make_channel",
    "read_channel",
]
