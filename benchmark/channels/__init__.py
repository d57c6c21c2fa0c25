"""Teleoperation: a policy at the far side of a network, with delayed, jittered, lossy messages."""

from .channel import Channel, Link
from .named import CHANNELS, channel_name, make_channel
from .reading import read_channel
from .recorded import parse_recorded, recorded
from .schedule import Turn, channel_seed, schedule
from .teleoperated import ANSWERED, Teleoperated, teleoperated

__all__ = [
    "ANSWERED",
    "CHANNELS",
    "Channel",
    "Link",
    "Teleoperated",
    "Turn",
    "channel_name",
    "channel_seed",
    "make_channel",
    "parse_recorded",
    "read_channel",
    "recorded",
    "schedule",
    "teleoperated",
]
