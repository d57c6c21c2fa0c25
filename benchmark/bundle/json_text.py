"""JSON in a single form: its writing, and its strict reading."""

import json
from collections.abc import Sequence
from typing import Any, TypeVar

from colift.base.errors import InputError

T = TypeVar("T")


def dump_json(content: Any) -> bytes:
    """Return the content as text, in ASCII."""
    return (json.dumps(content, indent=2, allow_nan=False) + "\n").encode()


def parse_json(data: bytes, file: str) -> dict[str, Any]:
    """Return the object of a JSON text written by :func:`dump_json`.

    Raises
    ------
    InputError
        If it is not an object, or has any other form, which other readers might understand
        differently.
    """
    try:
        content = json.loads(data)
        as_written = dump_json(content)  # Without repeated names; refuses numbers beyond a float.
    except (ValueError, RecursionError) as error:
        raise InputError(f"{file}: not valid JSON: {error}") from None
    if not isinstance(content, dict):
        raise InputError(f"{file}: must be one object {{...}}")
    if as_written != data:
        lines = zip(as_written.split(b"\n"), data.split(b"\n"), strict=False)
        line = next((i for i, (a, b) in enumerate(lines, 1) if a != b), data.count(b"\n") + 1)
        raise InputError(f"{file}: line {line} is not as colift writes it")
    return content


def pick(content: Any, path: str, kind: type[T] | tuple[type[T], ...], file: str) -> T:
    """Return the value at a dotted path, of the required type (a bool is not an int here).

    Raises
    ------
    InputError
        If it is missing or of another type.
    """
    value = content
    for name in path.split("."):
        if not isinstance(value, dict) or name not in value:
            raise InputError(f"{file}: {path} is missing")
        value = value[name]
    return of_type(value, kind, f"{file}: {path}")


def of_type(value: Any, kind: type[T] | tuple[type[T], ...], what: str) -> T:
    """Return a value of the required type.

    Raises
    ------
    InputError
        If it has another type; ``what`` begins the message.
    """
    kinds = kind if isinstance(kind, tuple) else (kind,)
    if type(value) not in kinds:
        raise InputError(f"{what} must be {_kinds_text(kinds)}, got {value!r:.80}")
    found: T = value
    return found


def _kinds_text(kinds: Sequence[type]) -> str:
    names = {
        str: "a text",
        int: "a whole number",
        float: "a number",
        bool: "true or false",
        dict: "an object",
        list: "a list",
        type(None): "null",
    }
    return " or ".join(names[kind] for kind in kinds)
