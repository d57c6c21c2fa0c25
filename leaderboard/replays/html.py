"""Replays in one HTML file that needs nothing else: to be mailed, or kept with a paper.

Its content security policy allows its own script and style, by their hashes, and nothing more: the
file cannot ask for anything from anywhere.
"""

import base64
import hashlib
import json
from collections.abc import Mapping, Sequence
from functools import cache
from html import escape
from importlib.resources import files
from typing import Any, Final

from .. import pages
from .geometry import geometry

SCRIPTS: Final = (
    "replay-words.js",
    "replay-lift.js",
    "replay-scene.js",
    "replay-curves.js",
    "replay-charts.js",
    "replay.js",
)
"""The player, in the order in which it is loaded."""

STYLE: Final = "replay.css"

PAGE_STYLE: Final = """
:root { color-scheme: light dark; }
body { margin: 0; background: #fff; color: #22262e;
  font: 16px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
main { max-width: 72rem; margin: 0 auto; padding: 1.5rem 1.25rem 3rem; }
h1 { font-size: 1.5rem; line-height: 1.25; margin: 0 0 0.8rem; text-wrap: balance; }
footer { margin-top: 2rem; font-size: 0.88rem; color: #5b6472; }
@media (prefers-color-scheme: dark) {
  body { background: #15181d; color: #e4e7ec; } footer { color: #a2abb8; } }
@media (max-width: 40rem) { main { padding: 1rem 0.9rem 2rem; } }
"""

KEYS: Final = (
    "Keys: space plays and pauses, the arrows go by a decision of the robot, with shift by a "
    "second, comma and full stop by a frame; G shows or hides the human-human team."
)
"""How the player is used without a mouse."""


def replay_data(replays: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Return what the player reads: the scene, and replays as :func:`.replay` makes them."""
    return {"geometry": geometry(), "replays": list(replays)}


def script_json(content: Any) -> str:
    """Return JSON that may stand in an HTML script element, whatever the strings in it say."""
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
    title = f"{first['policy']} lifts a table with a human"
    style = PAGE_STYLE + _static(STYLE)
    scripts = [_static(name) for name in SCRIPTS]
    allowed = " ".join(_hash(script) for script in scripts)
    rules = f"default-src 'none'; script-src {allowed}; style-src {_hash(style)}"
    told = f"Suite {first['suite']}, digest {first['suite_digest']}. " if first["suite"] else ""
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en"><head><meta charset="utf-8">',
            f'<meta http-equiv="Content-Security-Policy" content="{rules}">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{escape(title)}</title>",
            f"<style>{style}</style></head>",
            f"<body><main><h1>{escape(title)}</h1>",
            '<div data-replay="replay-data"><noscript>This replay needs JavaScript; it asks for '
            "nothing from the network.</noscript></div>",
            f"<footer>{escape(told + KEYS)} Made by colift.</footer></main>",
            f'<script type="application/json" id="replay-data">'
            f"{script_json(replay_data(replays))}</script>",
            *(f"<script>{script}</script>" for script in scripts),
            "</body></html>",
            "",
        ]
    )


def replay_files(replays: Sequence[Mapping[str, Any]]) -> dict[str, Mapping[str, Any]]:
    """Return a policy's chosen replays by the name of each one's own file, without its suffix."""
    return {f"{each['behaviour']}-{each['which']}": each for each in replays}


@cache
def _static(name: str) -> str:
    return files(pages).joinpath("static", name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    digest = hashlib.sha256(text.encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"
