"""Files of learned numbers: JSON objects with one part per line."""

import json
from collections.abc import Callable, Mapping
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any, TypeVar

from colift.base.errors import InputError

Model = TypeVar("Model")


def learned_json(parts: Mapping[str, Any]) -> str:
    """Return the content of a file with one part per line."""
    lines = (f"{json.dumps(name)}: {json.dumps(value)}" for name, value in parts.items())
    return "{\n" + ",\n".join(lines) + "\n}\n"


def read_learned(text: str, make: Callable[[Any], Model], kind: str) -> Model:
    """Return the model that ``make`` builds from the parts of :func:`learned_json`.

    Raises
    ------
    InputError
        If the text is not JSON, lacks a part, or the parts do not fit together.
    """
    try:
        return make(json.loads(text))
    except InputError:
        raise
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(f"not {kind}: {type(error).__name__}: {error}") from error


def load_learned(path: str | None, shipped: Traversable, read: Callable[[str], Model]) -> Model:
    """Return the model that ``read`` makes of a file; without a path, of the shipped file.

    Raises
    ------
    InputError
        If the file cannot be read, or ``read`` refuses its content.
    """
    if path is None:
        return read(shipped.read_text())
    try:
        return read(Path(path).read_text())
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: cannot be read: {error}") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
