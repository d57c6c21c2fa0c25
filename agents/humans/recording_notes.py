"""Notes at the top of a file of recordings: lines that begin with ``#``.

``# licence: TEXT`` and ``# cite: TEXT`` state the terms and the source of recordings, and are shown
where the recordings are used. Other notes are ignored.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Final

MARK: Final = "#"
LICENCE: Final = "licence"
CITE: Final = "cite"

LARGEST: Final = 1 << 16
"""Bytes that are read for notes."""


@dataclass(frozen=True)
class Notes:
    """Terms and source of recordings; empty if the file states none."""

    licence: str = ""
    cite: str = ""

    def text(self) -> str:
        """Return the notes as one line; empty if there are none."""
        parts = [self.licence and f"licence: {self.licence}", self.cite and f"cite: {self.cite}"]
        return "; ".join(filter(None, parts))


def notes_of(path: Path) -> Notes:
    """Return the notes of a file; none of one that is no text."""
    with path.open("rb") as file:
        text = file.read(LARGEST).removeprefix(b"\xef\xbb\xbf").decode(errors="replace")
    found: dict[str, str] = {}
    for line in text.splitlines():
        if not line.startswith(MARK):
            break
        name, colon, value = line.lstrip(f"{MARK} ").partition(":")
        if colon:
            found.setdefault(name.strip().lower(), value.strip())
    return Notes(licence=found.get(LICENCE, found.get("license", "")), cite=found.get(CITE, ""))


def without_notes(text: str) -> str:
    """Return the text of a file with empty lines instead of its notes, so that lines keep numbers.

    Parameters
    ----------
    text
        The file, each line ended by a line feed.
    """
    lines = text.split("\n")
    for i, line in enumerate(lines):
        if line.startswith(MARK):
            lines[i] = ""
        elif line.strip():
            break
    return "\n".join(lines)
