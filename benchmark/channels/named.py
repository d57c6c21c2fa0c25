"""The named channels, with the sources of their numbers."""

from collections.abc import Mapping
from pathlib import Path
from typing import Final

from colift.base.errors import InputError
from colift.base.near_names import did_you_mean
from colift.benchmark.channels.channel import Channel
from colift.benchmark.channels.reading import read_channel
from colift.benchmark.links.link import Link


def _both(link: Link) -> Channel:
    return Channel(down=link, up=link)


JITTER_MEAN: Final = 0.005
JITTER_DEVIATION: Final = 0.0066
"""Jitter of ``home`` and ``satellite`` [s]: its quantile 1 - 10^-3 is 49 ms, just within the 50 ms
that ITU-T Y.1541 (classes 0 and 1) allows a network. Mean and family are chosen."""

LOSS: Final = 0.01
"""Loss of ``home`` and ``satellite``: chosen, typical of a busy radio link. A network of the
classes 0 to 4 of ITU-T Y.1541 loses 10^-3 at most, which is one message in seven lifts."""

CHANNELS: Final[Mapping[str, Channel]] = {
    # Chosen: an idle switched network.
    "lan": _both(Link(delay=0.0002, jitter_mean=0.0002, jitter_deviation=0.0002)),
    # Delay and burst are chosen: a round trip of 40 ms between two broadband lines.
    "home": _both(
        Link(
            delay=0.015,
            jitter_mean=JITTER_MEAN,
            jitter_deviation=JITTER_DEVIATION,
            loss=LOSS,
            burst=2.0,
        )
    ),
    # 260 ms between earth stations over a geostationary satellite, and 5 ms for 1,000 km of optical
    # fibre on the ground: ITU-T G.114, annex A. The distance and the burst are chosen.
    "satellite": _both(
        Link(
            delay=0.265,
            jitter_mean=JITTER_MEAN,
            jitter_deviation=JITTER_DEVIATION,
            loss=LOSS,
            burst=3.0,
        )
    ),
}
"""The channels by name; the same numbers each way."""


def make_channel(text: str) -> Channel:
    """Return a channel by its name, or from a file; see :func:`.read_channel`.

    Raises
    ------
    InputError
        If there is neither, or the file cannot be used.
    """
    if text in CHANNELS:
        return CHANNELS[text]
    path = Path(text)
    if path.suffix == ".toml" or path.exists():
        return read_channel(path)
    near = did_you_mean(text, CHANNELS)
    raise InputError(
        f"unknown channel {text!r:.80}; {near}known: {', '.join(CHANNELS)}, or a file .toml"
    )


def channel_name(channel: Channel) -> str:
    """Return the name of a channel's numbers, or their description if they have none."""
    names = (name for name, known in CHANNELS.items() if known == channel)
    return next(names, str(channel))
