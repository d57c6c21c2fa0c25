"""BVH files: a skeleton, and the channels of its joints in each frame.

The place of a joint follows from its parent's: ``p = p_parent + R_parent t`` and
``R = R_parent R_1 R_2 R_3``, with the rotations in the order of the channels. ``t`` is the joint's
offset, or its channels of position where it has them, as Blender and MotionBuilder write them.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.recordings.motion import AXES, Motion
from colift.benchmark.recordings.texts import numbers, split_lines, text_in
from numpy.typing import NDArray

CHANNEL: Final = re.compile(r"[xyz](position|rotation)")

CENTIMETRE: Final = 0.01
"""The most usual unit; the format states none."""


@dataclass
class Joint:
    """A joint, or the end of a limb."""

    name: str
    parent: int
    offset: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    """From its parent, in the unit of the file."""
    channels: list[tuple[str, int]] = field(default_factory=list)
    """Name and column of each channel."""


def read(path: Path) -> tuple[Motion, ...]:
    """Return the joints and the ends of the limbs.

    Raises
    ------
    InputError
        If the skeleton or the frames are not as the format has them, or frames are missing.
    """
    where = str(path)
    before, mark, after = text_in(path).partition("\nMOTION")
    try:
        joints = _joints(iter(before.split()))
    except (StopIteration, ValueError, IndexError):
        raise InputError(
            f"{where}: the skeleton of this BVH file is not whole: export it again"
        ) from None
    skipped = before.count("\n") + 2
    lines = split_lines(after, " ", skipped)
    frames = next((line for line in lines if line.at(0).lower() == "frames:"), None)
    timed = next((line for line in lines if line.cells[:2] in (("Frame", "Time:"),)), None)
    if not mark or frames is None or timed is None:
        raise InputError(f"{where}: this BVH file has no motion, with 'Frames:' and 'Frame Time:'")
    if not frames.at(1).isdecimal():
        raise InputError(
            f"{where}, line {frames.number}: 'Frames:' is {frames.at(1)!r:.40}, must be a whole "
            "number: correct it, or export the file again"
        )
    data = [line for line in lines if line.number > timed.number]
    count = int(frames.at(1))
    width = sum(len(joint.channels) for joint in joints)
    if len(data) < count or any(len(line.cells) != width for line in data[:count]):
        raise InputError(
            f"{where}: {len(data)} frames of this BVH file are there, 'Frames:' says {count}, each "
            f"of {width} numbers: the file was cut off or edited; export or copy it again"
        )
    data = data[:count]
    titles = [f"{name} of {joint.name}" for joint in joints for name, _ in joint.channels]
    values = numbers(data, range(width), titles, ".", where)
    interval = float(numbers([timed], [2], ["Frame Time"], ".", where)[0, 0])
    return (
        Motion(
            kind="a BVH file",
            names=tuple(joint.name for joint in joints),
            times=interval * np.arange(count, dtype=np.float64),
            positions=CENTIMETRE * _places(joints, values),
            places=np.array([line.number for line in data], dtype=np.intp),
            unit="",
            metre=CENTIMETRE,
            up="Y",
        ),
    )


def _joints(words: Iterator[str]) -> list[Joint]:
    """Return the joints, each after its parent."""
    joints: list[Joint] = []
    open_joints: list[int] = []
    column = 0
    for word in words:
        match word.upper():
            case "ROOT" | "JOINT":
                joints.append(Joint(next(words), open_joints[-1] if open_joints else -1))
            case "END":
                next(words)
                joints.append(Joint(f"{joints[open_joints[-1]].name}_end", open_joints[-1]))
            case "{":
                open_joints.append(len(joints) - 1)
            case "}":
                open_joints.pop()
            case "OFFSET":
                joints[-1].offset = np.array([float(next(words)) for _ in range(3)])
            case "CHANNELS":
                for _ in range(int(next(words))):
                    name = next(words).lower()
                    if not CHANNEL.fullmatch(name):
                        raise ValueError
                    joints[-1].channels.append((name, column))
                    column += 1
    if open_joints or not joints:
        raise ValueError
    return joints


def _places(joints: list[Joint], values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the positions of the joints, shape (frames, joints, 3), in the unit of the file."""
    frames = len(values)
    places = np.empty((frames, len(joints), 3))
    turns = np.empty((len(joints), frames, 3, 3))
    for i, joint in enumerate(joints):
        shift = np.tile(joint.offset, (frames, 1))
        turn = np.broadcast_to(np.eye(3), (frames, 3, 3))
        for name, column in joint.channels:
            axis = AXES.index(name[0].upper())
            if name.endswith("position"):
                shift[:, axis] = values[:, column]
            else:
                turn = turn @ rotations(axis, np.radians(values[:, column]))
        if joint.parent < 0:
            places[:, i], turns[i] = shift, turn
        else:
            places[:, i] = (
                places[:, joint.parent] + (turns[joint.parent] @ shift[..., None])[..., 0]
            )
            turns[i] = turns[joint.parent] @ turn
    return places


def rotations(axis: int, angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the matrices of rotations about an axis by some angles [rad], shape (n, 3, 3)."""
    second, third = (axis + 1) % 3, (axis + 2) % 3
    made = np.zeros((len(angles), 3, 3))
    made[:, axis, axis] = 1.0
    made[:, second, second] = made[:, third, third] = np.cos(angles)
    made[:, third, second] = np.sin(angles)
    made[:, second, third] = -made[:, third, second]
    return made
