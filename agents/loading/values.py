"""Conversion of parameter values from text and to text.

Supported types are numbers, words, booleans, choices (``Literal``), tuples of one basic type with
``/`` between the items, and each of these or None.
"""

import math
import types
from typing import Any, Final, Literal, Union, get_args, get_origin

NONE: Final = "none"
"""Text of None, and of an empty tuple."""

_BOOLS: Final = {"true": True, "false": False}
_KINDS: Final = {float: "a number", int: "a whole number", bool: "true or false", str: "a word"}


def readable(hint: Any) -> bool:
    """Return whether values of a type can be read from text."""
    if _is_union(hint):
        return without_none(hint) is not hint and readable(without_none(hint))
    if get_origin(hint) is tuple:
        items = set(get_args(hint)) - {...}
        return len(items) == 1 and items <= set(_KINDS)
    return get_origin(hint) is Literal or hint in _KINDS


def read_value(hint: Any, text: str) -> Any:
    """Return the value of a readable type that a text stands for.

    A choice may be abbreviated if only one choice begins that way.

    Raises
    ------
    ValueError
        If the text is not a value of the type.
    """
    if not text:
        raise ValueError("no value")
    if _is_union(hint):
        return None if text.lower() == NONE else read_value(without_none(hint), text)
    if get_origin(hint) is Literal:
        return _choice(get_args(hint), text)
    if get_origin(hint) is tuple:
        return _tuple(get_args(hint), text)
    value = _BOOLS.get(text.lower()) if hint is bool else hint(text)
    if value is None or (isinstance(value, float) and math.isnan(value)):
        raise ValueError(f"not {kind(hint)}: {text}")
    return value


def write_value(value: Any) -> str:
    """Return the text that :func:`read_value` turns into a value; numbers have six digits."""
    if value is None or value == ():
        return NONE
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return "/".join(map(write_value, value))
    return f"{value:g}" if isinstance(value, float) else str(value)


def kind(hint: Any) -> str:
    """Return a description of the values of a readable type, such as ``a number``."""
    if _is_union(hint):
        return f"{kind(without_none(hint))}, or {NONE}"
    if get_origin(hint) is Literal:
        return f"one of {', '.join(repr(str(choice)) for choice in get_args(hint))}"
    if get_origin(hint) is tuple:
        items = get_args(hint)
        count = "" if items[-1] is ... else f"{len(items)} "
        return f"{count}values with / between, each {kind(items[0])}"
    return _KINDS[hint]


def without_none(hint: Any) -> Any:
    """Return X of the type ``X | None``, and any other type as it is."""
    if not _is_union(hint):
        return hint
    others = [each for each in get_args(hint) if each is not type(None)]
    return others[0] if len(others) == 1 else hint


def _is_union(hint: Any) -> bool:
    return get_origin(hint) in (Union, types.UnionType)


def _choice(choices: tuple[Any, ...], text: str) -> Any:
    exact = [choice for choice in choices if str(choice) == text]
    begun = [choice for choice in choices if str(choice).lower().startswith(text.lower())]
    (chosen,) = exact or begun
    return chosen


def _tuple(items: tuple[Any, ...], text: str) -> tuple[Any, ...]:
    parts = [] if text.lower() == NONE else text.split("/")
    hints = items[:1] * len(parts) if items[-1] is ... else items
    return tuple(read_value(hint, part) for hint, part in zip(hints, parts, strict=True))
