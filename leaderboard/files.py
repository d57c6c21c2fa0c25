"""Files that are there as a whole or not at all, whenever the machine stops."""

import json
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any


def write_json(
    path: Path, content: Mapping[str, Any], *, mode: int = 0o644, indent: int | None = 2
) -> None:
    """Write a JSON file; who reads it meanwhile sees the old one or the new one."""
    separators = (",", ":") if indent is None else None
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}-")
    try:
        with os.fdopen(handle, "w") as file:
            os.fchmod(file.fileno(), mode)
            text = json.dumps(content, indent=indent, separators=separators, allow_nan=False)
            file.write(text + "\n")
            file.flush()
            os.fsync(file.fileno())
        Path(temporary).replace(path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def read_json(path: Path) -> dict[str, Any]:
    """Return the content of a JSON file."""
    content: dict[str, Any] = json.loads(path.read_text())
    return content
