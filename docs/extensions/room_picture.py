"""A picture of folders, each of which imports only from those below it.

A line ``# name`` begins a part; each further line is a row of its folders, from the top, separated
by ``|``. A folder is ``name: words``; ``.`` is the part itself, and an empty cell a gap. An arrow
joins each folder marked ``>`` with the next one.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from itertools import pairwise
from typing import Final

WIDTH: Final = 168
"""Width of a folder [px]."""

HEIGHT: Final = 42
"""Height of a folder [px]."""

GAP: Final = 12
"""Distance between folders, and between them and the edge of their part [px]."""

LEFT: Final = 104
"""Width of the names of the parts [px]."""

COLUMNS: Final = 4


@dataclass(frozen=True, kw_only=True)
class Room:
    """A folder in the picture."""

    name: str
    """Its path, such as ``benchmark/world``."""
    part: str
    """The path of its part, such as ``benchmark``."""
    words: str
    """Its content."""
    row: int
    """Its row in the whole picture, counted from the top."""
    column: int
    on_the_way: bool
    """Whether it is joined with the next such folder by an arrow."""


def read_rooms(lines: Sequence[str]) -> list[Room]:
    """Return the folders of a text.

    Raises
    ------
    ValueError
        If a row has no part, or more than ``COLUMNS`` folders.
    """
    part, row, rooms = "", -1, []
    for line in filter(str.strip, lines):
        if line.startswith("# "):
            part = line[2:].strip()
            continue
        cells = [cell.strip() for cell in line.split("|")]
        if not part or len(cells) > COLUMNS:
            raise ValueError(f"{line!r} has no part above it, or more than {COLUMNS} folders")
        row += 1
        for column, cell in enumerate(cells):
            if cell:
                name, _, words = cell.removeprefix(">").strip().partition(": ")
                path = part if name == "." else f"{part}/{name}"
                marked = cell.startswith(">")
                rooms.append(
                    Room(
                        name=path, part=part, words=words, row=row, column=column, on_the_way=marked
                    )
                )
    return rooms


def drawn(rooms: Sequence[Room]) -> str:
    """Return the picture as SVG."""
    parts = list(dict.fromkeys(room.part for room in rooms))
    top = {
        room.row: room.row * (HEIGHT + GAP) + (2 * parts.index(room.part) + 1) * GAP
        for room in rooms
    }
    width = LEFT + COLUMNS * (WIDTH + GAP)
    height = max(top.values()) + HEIGHT + 2 * GAP
    pieces = [
        *(_panel(part, [top[room.row] for room in rooms if room.part == part], width)
          for part in parts),
        *_arrows([room for room in rooms if room.on_the_way], top),
        *(_box(room, top[room.row]) for room in rooms),
    ]  # fmt: skip
    label = "Folders of colift; each imports only from those below it"
    return (
        f'<div class="drawing"><svg viewBox="0 0 {width} {height}" role="img" '
        f'aria-label="{label}">{"".join(pieces)}</svg></div>'
    )


def _panel(part: str, tops: Sequence[int], width: int) -> str:
    """Return the ground of a part, with its name."""
    first, last = min(tops) - GAP, max(tops) + HEIGHT + GAP
    return (
        f'<rect class="ground" x="0" y="{first}" width="{width}" height="{last - first - 4}" '
        f'rx="6"/><text class="part" x="{GAP}" y="{first + GAP + HEIGHT / 2 + 5}">'
        f"{part.rpartition('/')[2]}</text>"
    )


def _box(room: Room, top: int) -> str:
    """Return a folder."""
    x = LEFT + room.column * (WIDTH + GAP)
    kind = "box way" if room.on_the_way else "box"
    name = room.name.rpartition("/")[2]
    return (
        f'<rect class="{kind}" x="{x}" y="{top}" width="{WIDTH}" height="{HEIGHT}" rx="4"/>'
        f'<text class="name" x="{x + 10}" y="{top + 18}">{escape(name)}</text>'
        f'<text class="words" x="{x + 10}" y="{top + 33}">{escape(room.words)}</text>'
    )


def _arrows(way: Sequence[Room], top: dict[int, int]) -> Iterator[str]:
    """Yield the arrows between neighbours."""
    for upper, lower in pairwise(way):
        x = LEFT + lower.column * (WIDTH + GAP) + WIDTH / 2
        start, end = top[upper.row] + HEIGHT, top[lower.row]
        yield f'<path class="arrow" d="M{x} {start}V{end - 1}m-4 -5l4 5l4 -5"/>'
