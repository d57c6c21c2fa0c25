"""Channels in bundles: their numbers, and a hash of the code that uses them."""

from collections.abc import Mapping
from typing import Any, Final

from colift.base.errors import InputError
from colift.base.identity import code_hash
from colift.benchmark.channels.channel import Channel
from colift.benchmark.channels.reading import parse_channel
from colift.benchmark.channels.teleoperated import teleoperated
from colift.benchmark.links.link import Link

CODE: Final = "code"
"""The key of the hash."""


def recorded(channel: Channel) -> dict[str, Any]:
    """Return all numbers of a channel, and the hash of the code that applies them to a lift."""
    return {**channel.plain(), CODE: _code()}


def parse_recorded(content: Mapping[str, Any], where: str) -> Channel:
    """Return the channel from the content that :func:`recorded` returns.

    Parameters
    ----------
    content
        Numbers and hash.
    where
        Their origin, for messages.

    Raises
    ------
    InputError
        If something is missing, of another type or out of range, or the code has changed since.
    """
    numbers = {name: value for name, value in content.items() if name != CODE}
    channel = parse_channel(numbers, where, whole=True)
    if CODE not in content:
        raise InputError(f"{where}: {CODE} is missing")
    if content[CODE] != _code():
        raise InputError(
            f"{where}.{CODE} is {content[CODE]!r:.80}, here it is {_code()!r}: the code of "
            "channels has changed since; run the policy again"
        )
    return channel


def _code() -> str:
    return code_hash(teleoperated, Channel, Link)
