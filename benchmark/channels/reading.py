"""Channels from files and from the recipes of bundles."""

from collections.abc import Iterable, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, Final

from colift.base.errors import InputError
from colift.base.near_names import did_you_mean
from colift.base.text import parse_toml, read_bytes
from colift.benchmark.channels.channel import Channel
from colift.benchmark.links.link import Link

LONGEST: Final = 16 * 1024
"""Largest file [bytes]: the time to read TOML can grow with the square of its length."""

LINKS: Final = tuple(each.name for each in fields(Channel))
NUMBERS: Final = tuple(each.name for each in fields(Link))


def read_channel(path: Path) -> Channel:
    """Return the channel of a TOML file.

    Its tables are ``down`` and ``up``, their keys the fields of :class:`.Link`; a key that is left
    out has its default.

    Raises
    ------
    InputError
        If there is no such file, it is too long or not TOML, a key is unknown, or a value is of
        another type or out of range; the message names the file, the key and the valid values.
    """
    content = parse_toml(read_bytes(path, LONGEST), str(path))
    return parse_channel(content, str(path))


def parse_channel(content: Mapping[str, Any], where: str, *, whole: bool = False) -> Channel:
    """Return the channel of a nested mapping, as :meth:`.Channel.plain` returns one.

    Parameters
    ----------
    content
        The mapping.
    where
        Its origin, for messages.
    whole
        Whether every key must be there, and every number must be a float.

    Raises
    ------
    InputError
        As :func:`read_channel`.
    """
    _check_keys(content, LINKS, where, whole=whole)
    return Channel(
        **{name: _link(link, f"{where}: {name}", whole) for name, link in content.items()}
    )


def _link(content: object, where: str, whole: bool) -> Link:
    if not isinstance(content, dict):
        raise InputError(f"{where} must be a table, got {content!r:.80}")
    _check_keys(content, NUMBERS, where, whole=whole)
    values = {
        name: _value(name, value, f"{where}.{name}", whole) for name, value in content.items()
    }
    try:
        return Link(**values)
    except InputError as error:
        raise InputError(f"{where}.{error}") from None


def _value(name: str, value: object, where: str, whole: bool) -> Any:
    if name == "jitter":
        if not isinstance(value, str):
            raise InputError(f"{where} must be a text, got {value!r:.80}")
        return value
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError(f"{where} must be a number, got {value!r:.80}")
    if whole and isinstance(value, int):
        raise InputError(f"{where} must be written as colift does, {float(value)}, got {value}")
    return float(value)


def _check_keys(
    content: Mapping[str, Any], known: Iterable[str], where: str, *, whole: bool
) -> None:
    """Refuse an unknown key, and a missing one if all must be there."""
    for key in content:
        if key not in known:
            near = did_you_mean(key, known)
            raise InputError(f"{where}: unknown key {key!r:.80}; {near}known: {', '.join(known)}")
    missing = [key for key in known if key not in content]
    if whole and missing:
        raise InputError(f"{where}: {missing[0]} is missing")
