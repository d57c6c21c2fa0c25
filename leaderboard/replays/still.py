"""A still of a replay: the moment at which the table is highest, as a PNG."""

import contextlib
import functools
import io
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from colift.benchmark.rendering.scene import Scene
from colift.benchmark.robots.robot import DEFAULT_ROBOT
from colift.leaderboard.replays.replay import UNIT
from numpy.typing import NDArray
from PIL import Image

SIZE: Final = (1200, 630)
"""Width and height [px]: those that sites ask for to show a link with a picture."""


def raised(replay: Mapping[str, Any]) -> int:
    """Return the frame of a replay in which the human's end is highest, from 0."""
    return int(_heights(replay["human"]).argmax())


def still(replay: Mapping[str, Any]) -> bytes:
    """Return the picture of a replay with at least one frame; see :func:`.replay_content`."""
    at = raised(replay)
    ends = [float(_heights(replay[end])[at]) for end in ("human", "robot")]
    places = [
        float(_heights(each["values"])[at])
        for each in sorted(replay.get("drawn", ()), key=lambda each: each["goal"])
        if each["where"] == "place"
    ]
    return _png(replay.get("holder", DEFAULT_ROBOT), *ends, tuple(places))


@functools.lru_cache(maxsize=32)
def _png(partner: str, human: float, robot: float, places: tuple[float, ...]) -> bytes:
    """Draw the ends of the table at their heights, and a ball with its target place, if any."""
    ball = len(places) == 2
    with contextlib.closing(Scene(partner, ball=ball)) as scene:
        scene.pose(human, robot)
        if ball:
            scene.table.roll(*places)
        picture = Image.fromarray(scene.picture(*SIZE))
    file = io.BytesIO()
    picture.save(file, "PNG", optimize=True)
    return file.getvalue()


def _heights(changes: list[int]) -> NDArray[np.float64]:
    """Return heights [m] from a first one and changes; the inverse of :func:`.changes`."""
    return np.cumsum(changes) * UNIT
