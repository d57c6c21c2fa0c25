"""The JSON document of a command: one on stdout, whatever happens."""

import json
from typing import Any, Final

_PRINTED: Final[list[bool]] = []


def begin() -> None:
    """Say that a command starts: none has been printed."""
    _PRINTED.clear()


def print_json(content: Any) -> None:
    """Print JSON; all numbers must be finite, since JSON has no others."""
    print(json.dumps(content, indent=2, allow_nan=False))
    _PRINTED.append(True)


def print_json_error(message: str) -> None:
    """Print an error as the document, unless the command has printed one."""
    if not _PRINTED:
        print(json.dumps({"error": message}))
