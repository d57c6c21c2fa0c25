"""Replays in one self-contained HTML file, to be mailed or kept with a paper.

Its content security policy allows only its own script and style, by their hashes: the file cannot
load anything.
"""

import json
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Any, Final

from colift.benchmark.rendering.page import render, style
from colift.leaderboard.replays.geometry import geometry
from markupsafe import Markup

SCENE: Final = ("replay-words.js", "replay-lift.js", "replay-bodies.js", "replay-scene.js")
"""The scripts that draw a lift, in the order in which they are loaded."""

SCRIPTS: Final = (*SCENE, "replay-curves.js", "replay-charts.js", "replay.js")
"""The scripts of the player, in the order in which they are loaded."""

STYLE: Final = "replay.css"

KEYS: Final = (
    "Keys: space plays and pauses; the arrows move by one decision of the robot, with shift by a "
    "second; comma and full stop move by a frame; G shows or hides the second of two people."
)
"""Use of the player by keyboard."""


def replay_data(replays: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Return the player's input: the scene, and replays from :func:`.replay_content`."""
    return {"geometry": geometry(), "replays": list(replays)}


def script_json(content: Any) -> str:
    """Return JSON that is safe in an HTML script element, with any strings."""
    text = json.dumps(content, separators=(",", ":"), allow_nan=False)
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return text


def replay_page(replays: Sequence[Mapping[str, Any]]) -> str:
    """Return the page of one or more replays of a policy.

    Raises
    ------
    ValueError
        If there is none.
    """
    if not replays:
        raise ValueError("there must be a replay")
    first = replays[0]
    title = f"{first['policy']} lifts a table with a person"
    suite = f"Suite {first['suite']}, digest {first['suite_digest']}. " if first["suite"] else ""
    return render(
        __package__,
        "replay.html",
        title=title,
        style=Markup(style() + _static(STYLE)),
        scripts=[Markup(_static(name)) for name in SCRIPTS],
        footer=suite + KEYS,
        data=Markup(script_json(replay_data(replays))),
    )


def replay_files(replays: Sequence[Mapping[str, Any]]) -> dict[str, Mapping[str, Any]]:
    """Return a policy's chosen replays by the name of each one's own file, without its suffix."""
    return {f"{each['behaviour']}-{each['which'] or each['lift']}": each for each in replays}


@cache
def _static(name: str) -> str:
    return files("colift.leaderboard").joinpath("static", name).read_text(encoding="utf-8")
