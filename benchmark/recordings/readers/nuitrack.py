"""Text of the skeleton tracker Nuitrack, as in the data set NuiSI.

Each line has the number of the frame, the time [ms], the number of joints, and for each joint its
type, a confidence, its place in the picture (3) and its place in space (3) [mm], with Y up.
"""

from pathlib import Path
from typing import Final

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.recordings.motion import Motion
from colift.benchmark.recordings.texts import Line, numbers, split_lines, text_in

JOINTS: Final = (
    *("none", "head", "neck", "torso", "waist"),
    *("left_collar", "left_shoulder", "left_elbow", "left_wrist", "left_hand", "left_fingertip"),
    *("right_collar", "right_shoulder", "right_elbow", "right_wrist", "right_hand"),
    *("right_fingertip", "left_hip", "left_knee", "left_ankle", "left_foot"),
    *("right_hip", "right_knee", "right_ankle", "right_foot"),
)
"""Joints by their type (Nuitrack's documentation, ``nuitrack::JointType``)."""

BEFORE: Final = 3
"""Fields before the joints."""

FIELDS: Final = 8
"""Fields of a joint."""


def read(path: Path) -> tuple[Motion, ...]:
    """Return the joints; those of no confidence, and frames without a person, are not seen.

    Raises
    ------
    InputError
        If a line has another number of fields.
    """
    where = str(path)
    lines = split_lines(text_in(path), ",")
    width = BEFORE + FIELDS * len(JOINTS)
    for line in lines:
        if len(line.cells) not in (BEFORE, width):
            raise InputError(
                f"{where}, line {line.number}: {len(line.cells)} fields, must be {width}, or "
                f"{BEFORE} in a frame without a person"
            )
    padded = [Line(line.number, line.cells + ("",) * (width - len(line.cells))) for line in lines]
    titles = [f"field {i + 1}" for i in range(width)]
    values = numbers(padded, range(width), titles, ".", where)
    joints = values[:, BEFORE:].reshape(len(lines), len(JOINTS), FIELDS)
    positions = 0.001 * joints[..., -3:]
    positions[joints[..., 1] == 0.0] = np.nan
    return (
        Motion(
            kind="a text of the skeleton tracker Nuitrack",
            names=JOINTS[1:],
            times=0.001 * (values[:, 1] - values[0, 1]),
            positions=positions[:, 1:],
            places=np.array([line.number for line in lines]),
            unit="mm",
            metre=0.001,
            up="Y",
            up_source="format",
        ),
    )
