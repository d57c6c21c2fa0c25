"""Changes of a recorded file: lines of a text, pixels of a picture."""

import difflib
import io
from typing import Final

import numpy as np
from PIL import Image, ImageSequence

LINES: Final = 20
"""Most lines of a difference that are shown."""


def file_change(name: str, old: bytes | None, new: bytes) -> str:
    """Return the difference between a file's former and present content, in words; else empty.

    Parameters
    ----------
    name
        Name of the file; that of a text file ends in ``.txt`` or ``.svg``.
    old, new
        Former and present content; the former is None for a new file.
    """
    if old is None:
        return f"{name}: new"
    if old == new:
        return ""
    is_text = name.endswith((".txt", ".svg"))
    return _text_change(name, old, new) if is_text else _pixel_change(name, old, new)


def _text_change(name: str, old: bytes, new: bytes) -> str:
    before, after = (text.decode().splitlines() for text in (old, new))
    lines = list(difflib.unified_diff(before, after, n=0, lineterm=""))[2:]
    changed = [line for line in lines if not line.startswith("@@")]
    more = len(changed) - LINES
    shown = changed[:LINES] + ([f"... and {more} more lines"] if more > 0 else [])
    return "\n".join((f"{name}: {len(changed)} lines differ", *(f"  {line}" for line in shown)))


def _pixel_change(name: str, old: bytes, new: bytes) -> str:
    before, after = _frames(old), _frames(new)
    if {each.shape for each in before} != {each.shape for each in after}:
        return f"{name}: another size"
    if len(before) != len(after):
        return f"{name}: {len(after)} pictures instead of {len(before)}"
    shares = [np.any(a != b, axis=-1).mean() for a, b in zip(before, after, strict=True)]
    return f"{name}: {100 * float(np.mean(shares)):.2g} % of the pixels differ"


def _frames(picture: bytes) -> list[np.ndarray]:
    with Image.open(io.BytesIO(picture)) as image:
        return [np.asarray(frame.convert("RGB")) for frame in ImageSequence.Iterator(image)]
