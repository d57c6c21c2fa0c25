"""AMC files of Acclaim, with the skeleton in an ASF file beside them, as in HDM05 and CMU.

A bone turns by ``C M C^-1`` against its parent: ``C`` is its ``axis``, fixed, and ``M`` its degrees
of freedom in a frame. It ends at ``p = p_parent + R length direction``.
"""

from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.recordings.motion import LENGTHS, Motion
from colift.benchmark.recordings.readers.bvh import rotations
from colift.benchmark.recordings.texts import text_in
from numpy.typing import NDArray

ROOT: Final = "root"

SHIFTS: Final = ("tx", "ty", "tz")
"""Degrees of freedom of the root's place."""


@dataclass(frozen=True, kw_only=True)
class Bone:
    """A bone of the skeleton; the root has no length."""

    direction: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    length: float = 0.0
    axis: NDArray[np.float64] = field(default_factory=lambda: np.eye(3))
    """Its fixed rotation, shape (3, 3)."""
    freedoms: tuple[str, ...] = ()
    """Its degrees of freedom in the order of the motion file, such as ``rx``."""


@dataclass(frozen=True, kw_only=True)
class Skeleton:
    """A skeleton."""

    bones: Mapping[str, Bone]
    parents: Mapping[str, str]
    """The bone that each bone begins at, parents before children."""
    metre: float
    """Metres per unit of length."""


def read(path: Path) -> tuple[Motion, ...]:
    """Return the far ends of the bones, and the root; the file has no rate.

    Raises
    ------
    InputError
        If there is no skeleton beside it, or either file is not as the format has it.
    """
    source = _skeleton_file(path)
    described, moved = _lines(source), _lines(path)
    try:
        skeleton = _skeleton(described)
    except (StopIteration, ValueError, IndexError, KeyError) as error:
        reason = f" ({error})" if str(error) else ""
        raise InputError(
            f"{source}: this skeleton (ASF) is not whole{reason}: get it again"
        ) from None
    try:
        frames, places = _frames(moved, skeleton.bones)
        ends = _ends(skeleton, frames)
    except (ValueError, IndexError, KeyError) as error:
        raise InputError(
            f"{path}: this motion (AMC) does not fit the skeleton {source.name} ({error}): put its "
            "own ASF file beside it"
        ) from None
    return (
        Motion(
            kind="an AMC file",
            names=(ROOT, *skeleton.parents),
            times=np.arange(len(places), dtype=float),
            positions=skeleton.metre * ends,
            places=np.array(places),
            unit="in",
            metre=skeleton.metre,
            up="Y",
            up_source="format",
            clocked=False,
        ),
    )


def _skeleton_file(path: Path) -> Path:
    """Return the ASF file of an AMC file: the one with the longest common name, or the only one."""
    found = sorted(each for each in path.parent.iterdir() if each.suffix.lower() == ".asf")
    named = [each for each in found if path.stem.lower().startswith(each.stem.lower())]
    if named:
        return max(named, key=lambda each: len(each.stem))
    if len(found) == 1:
        return found[0]
    raise InputError(
        f"{path}: this is an AMC file; its skeleton, an ASF file, must be beside it, with the same "
        f"name or its beginning, such as {path.stem}.asf"
    )


def _lines(path: Path) -> list[tuple[int, list[str]]]:
    """Return the words of each line, with its number, without comments and empty lines."""
    rows = enumerate(text_in(path).split("\n"), 1)
    split = ((number, row.partition("#")[0].split()) for number, row in rows)
    return [(number, words) for number, words in split if words]


def _skeleton(lines: Sequence[tuple[int, list[str]]]) -> Skeleton:
    bones: dict[str, Bone] = {ROOT: Bone()}
    parents: dict[str, str] = {}
    scale, section, degrees = 1.0, "", True
    rest = iter(words for _, words in lines)
    for words in rest:
        key = words[0].lower()
        if key.startswith(":"):
            section = key
        elif section == ":units" and key == "length":
            scale = float(words[1])
        elif section == ":units" and key == "angle":
            degrees = words[1].lower().startswith("deg")
        elif section == ":root" and key == "order":
            bones[ROOT] = Bone(freedoms=tuple(word.lower() for word in words[1:]))
        elif section == ":bonedata" and key == "begin":
            name, bone = _bone(rest, degrees)
            bones[name] = bone
        elif section == ":hierarchy" and key not in ("begin", "end"):
            parents |= dict.fromkeys(words[1:], words[0])
    if not 0.0 < scale < np.inf:
        raise ValueError(f"its unit of length is {scale:g}, must be positive")
    missing = [axis for axis in SHIFTS if axis not in bones[ROOT].freedoms]
    if missing:
        raise ValueError(f"its root has no {missing[0]}")
    return Skeleton(bones=bones, parents=_in_order(parents, bones), metre=LENGTHS["in"] / scale)


def _in_order(parents: Mapping[str, str], bones: Container[str]) -> dict[str, str]:
    """Return the parents of bones with each bone after its parent; else in their order."""
    ordered: dict[str, str] = {}
    waiting = [*parents]
    while waiting:
        for name in waiting:
            if name in bones and name != ROOT and parents[name] in (ROOT, *ordered):
                ordered[name] = parents[name]
        left = [name for name in waiting if name not in ordered]
        if len(left) == len(waiting):
            raise ValueError(f"its bone {left[0]!r:.40} is not described, or hangs on no other")
        waiting = left
    return ordered


def _bone(rest: Iterator[list[str]], degrees: bool) -> tuple[str, Bone]:
    told: dict[str, list[str]] = {}
    while (words := next(rest))[0].lower() != "end":
        told[words[0].lower()] = words[1:]
    *angles, order = told["axis"]
    values = [float(angle) for angle in angles]
    return told["name"][0], Bone(
        direction=np.array([float(word) for word in told["direction"]]),
        length=float(told["length"][0]),
        axis=_turn([f"r{axis.lower()}" for axis in order], np.array([values]), degrees)[0],
        freedoms=tuple(word.lower() for word in told.get("dof", [])),
    )


def _turn(
    freedoms: Sequence[str], values: NDArray[np.float64], degrees: bool = True
) -> NDArray[np.float64]:
    """Return the rotations about fixed axes, the first freedom first, shape (frames, 3, 3)."""
    turn = np.broadcast_to(np.eye(3), (len(values), 3, 3))
    for k, freedom in enumerate(freedoms):
        if freedom.startswith("r"):
            angles = np.radians(values[:, k]) if degrees else values[:, k]
            turn = rotations("xyz".index(freedom[1]), angles) @ turn
    return turn


def _frames(
    lines: Sequence[tuple[int, list[str]]], bones: Mapping[str, Bone]
) -> tuple[dict[str, NDArray[np.float64]], list[int]]:
    """Return the values of each bone, shape (frames, freedoms), and the line of each frame."""
    places: list[int] = []
    values: dict[str, list[list[float]]] = {name: [] for name in bones if bones[name].freedoms}
    for number, words in lines:
        if len(words) == 1 and words[0].isdigit():
            places.append(number)
        elif places and not words[0].startswith(":"):
            found = [float(word) for word in words[1:]]
            if len(found) != len(bones[words[0]].freedoms):
                raise ValueError(f"line {number}: {len(found)} numbers for {words[0]}")
            values[words[0]].append(found)
    if not places or any(len(rows) != len(places) for rows in values.values()):
        raise ValueError(f"frame {len(places)} is not whole")
    return {name: np.array(rows) for name, rows in values.items()}, places


def _ends(skeleton: Skeleton, frames: Mapping[str, NDArray[np.float64]]) -> NDArray[np.float64]:
    """Return the ends of the root and of the bones, shape (frames, bones, 3), in their unit."""
    root = frames[ROOT]
    freedoms = skeleton.bones[ROOT].freedoms
    shift = np.stack([root[:, freedoms.index(axis)] for axis in SHIFTS], axis=1)
    turns, ends = {ROOT: _turn(freedoms, root)}, {ROOT: shift}
    for name, parent in skeleton.parents.items():
        bone = skeleton.bones[name]
        turn = turns[parent]
        if bone.freedoms:
            turn = turn @ (bone.axis @ _turn(bone.freedoms, frames[name]) @ bone.axis.T)
        turns[name] = turn
        ends[name] = ends[parent] + turn @ (bone.length * bone.direction)
    return np.stack([*ends.values()], axis=1)
