"""The recordings of a suite in words: the lifts that were read, and the changes to them."""

from collections.abc import Iterable
from typing import Any, Final

from colift.agents.humans import AsRecorded
from colift.agents.humans.as_recorded import fastest_of
from colift.benchmark.suites.catalogue import FROM_FILES, PLAYED
from colift.benchmark.suites.suite import Suite
from colift.benchmark.suites.treatments import plain_treatments, treatments
from colift.benchmark.tables.printing import counted, show

FEW: Final = 10
"""Number of lifts below which an interval says little."""

ENLARGED: Final = 2.0
"""Scale above which noise is mentioned, since it is enlarged with the movement."""


def recordings_text(suite: Suite) -> str:
    """Return one line on the recordings or live lifts of a suite; empty if it has none."""
    lifts, behaviour = counted(suite.size, "lift"), suite.scenarios[0].behaviour
    if behaviour == PLAYED:
        return f"Read {lifts}, played as they were."
    if behaviour not in FROM_FILES:
        return ""
    found = treatments(suite).values()
    parts = [
        f"{_range((each.rate_hz for each in found), '.0f')} Hz",
        f"moving {_range((each.range_m for each in found), '.2f')} m",
    ]
    humans = [each.human for each in suite.scenarios if isinstance(each.human, AsRecorded)]
    if humans:
        fastest = _range((fastest_of(human.recording) for human in humans), ".2f")
        hand = suite.hand_speed
        parts += [f"fastest {fastest} m/s (the robot's hand: {hand:g})", "played as recorded"]
        return f"Read {lifts}: {', '.join(parts)}."
    inverted = sum(each.inverted for each in found)
    parts += [
        f"scaled {_range((each.scale for each in found), '.2f')}",
        f"slowed down {_range((each.slow_down for each in found), '.1f')} times",
        f"{inverted} inverted" + (" (further down than up)" if inverted else ""),
    ]
    enlarged = sum(each.scale > ENLARGED for each in found)
    if enlarged:
        parts.append(f"{enlarged} enlarged more than {ENLARGED:g} times, noise included")
    return f"Read {lifts}: {', '.join(parts)}."


def show_recordings(suite: Suite, as_json: bool = False, name: str = "") -> None:
    """Print the recordings of a suite, if it has some, unless JSON is to be alone on stdout.

    A name is that of their source, which is put before them.
    """
    text = recordings_text(suite)
    if text and not as_json:
        show(f"{name}: {text}" if name else text, _people(suite), "")


def recordings_json(suite: Suite) -> dict[str, Any]:
    """Return what ``--json`` adds for a suite of recordings: one object per trial."""
    found = plain_treatments(suite)
    return {"recordings": found} if found else {}


def _people(suite: Suite) -> str:
    few = f" Of fewer than {FEW} lifts, they say little." if suite.size < FEW else ""
    return f"Intervals and tests hold for further lifts of the same people, however few.{few}"


def _range(values: Iterable[float], form: str) -> str:
    """Return the smallest and the largest value, or both as one if they look alike."""
    ordered = sorted(values)
    low, high = format(ordered[0], form), format(ordered[-1], form)
    return low if low == high else f"{low} to {high}"
