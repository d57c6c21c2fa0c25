"""The message of a page whose person takes hold of the table."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from colift.base.errors import InputError

PRESETS: Final = ("mouse", "touch", "pen", "keyboard", "gamepad")

LONGEST_PLAYOUT_S: Final = 0.150
"""Longest time by which a page may delay the display of frames [s]."""

LONGEST_DELAY_S: Final = 0.150
"""Longest playout delay of samples [s]."""

FIRST_DELAY_S: Final = dict.fromkeys(PRESETS, 0.030) | {"touch": 0.060, "pen": 0.060}
"""Playout delay of samples before anything was measured [s]: a browser holds back the events of a
finger until its next picture, and passes on those of a mouse at once."""

_KEPT: Final = 400
"""Longest text that is kept of a page's description of itself [characters]."""


@dataclass(frozen=True, kw_only=True)
class Grip:
    """A hand that is closed.

    Raises
    ------
    InputError
        If a number is missing or out of range; the message names it.
    """

    offset: float
    """Clock of the room minus clock of the page [s]."""
    playout: float
    """Delay with which the page wants to show frames [s]."""
    delay: float | None = None
    """Playout delay of samples that the page asks for [s]; None leaves it to the room."""
    device: Mapping[str, Any] = field(default_factory=dict)
    """The page's description of its input and its display; kept as it is."""

    @property
    def preset(self) -> str:
        """The kind of the input, one of :data:`PRESETS`."""
        return str(self.device.get("preset", PRESETS[0]))

    @classmethod
    def parse(cls, content: Mapping[str, Any]) -> "Grip":
        """Return the grip of a page's message."""
        delay = content.get("delay")
        return cls(
            offset=_number(content, "offset", -1e12, 1e12) / 1000,
            playout=_number(content, "playout", 0, 1000 * LONGEST_PLAYOUT_S) / 1000,
            delay=None if delay is None else _number(content, "delay", 0, 1e3) / 1000,
            device=_device(content),
        )


def _number(content: Mapping[str, Any], name: str, low: float, high: float) -> float:
    value = content.get(name)
    if isinstance(value, int | float) and not isinstance(value, bool) and low <= value <= high:
        return float(value)  # NaN is in no range.
    raise InputError(f"{name} must be a number of {low:g} to {high:g} ms, got {value!r:.40}")


def _device(content: Mapping[str, Any]) -> dict[str, Any]:
    """Return the plain values of a page's description of itself."""
    said = content.get("input")
    described = {**said} if isinstance(said, dict) else {}
    if described.get("preset", PRESETS[0]) not in PRESETS:
        raise InputError(f"preset must be one of {', '.join(PRESETS)}")
    described |= {name: content[name] for name in ("rtt", "family") if name in content}
    kept = {
        str(name): value
        for name, value in described.items()
        if value is None or isinstance(value, str | int | float)
    }
    if len(str(kept)) > _KEPT:
        raise InputError(f"the description of the input must have at most {_KEPT} characters")
    return kept
