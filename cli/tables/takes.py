"""The takes of files of motion capture as tables and as JSON."""

from collections.abc import Sequence
from typing import Any, Final

from colift.benchmark.recordings.takes import Take
from colift.benchmark.tables.printing import counted, left, table
from rich.table import Table

MOST: Final = 20
"""Most takes in a table; more are one row of all."""


def takes_table(takes: Sequence[Take]) -> Table:
    """Return what was read: marker, axis, unit, rate, lifts, their heights and durations, gaps."""
    kinds = dict.fromkeys(take.motion.kind for take in takes)
    return table(
        f"Read {counted(len(takes), 'recording')}: {', '.join(kinds)}",
        (left("recording"), left("hand"), "up", "unit", "Hz", "lifts", "rise m", "in s", "gaps"),
        [*(_row(take) for take in takes[:MOST]), *_rest(takes[MOST:])],
        caption="rise, in: height and duration of the rises; gaps: those in which the hand was not "
        "seen, and the longest.",
    )


def _row(take: Take) -> list[str]:
    return [
        _name(take),
        take.track.hand,
        take.track.up,
        take.motion.unit or "m?",
        f"{take.rate:.4g}",
        *_numbers([take]),
    ]


def _rest(takes: Sequence[Take]) -> list[list[str]]:
    if not takes:
        return []
    return [[f"{len(takes)} more", "", "", "", "", *_numbers(takes)]]


def _numbers(takes: Sequence[Take]) -> list[str]:
    lifts = [lift for take in takes for lift in take.lifts]
    gaps = [gap for take in takes for gap in take.gaps]
    return [
        str(len(lifts)),
        _range([lift.rise for lift in lifts], ".2f"),
        _range([lift.duration for lift in lifts], ".1f"),
        f"{len(gaps)} ({max(gaps):.2f} s)" if gaps else "none",
    ]


def _range(values: Sequence[float], form: str) -> str:
    if not values:
        return "-"
    low, high = format(min(values), form), format(max(values), form)
    return low if low == high else f"{low} to {high}"


def _name(take: Take) -> str:
    return f"{take.file.name} {take.motion.take}".strip()


def choices_text(takes: Sequence[Take]) -> list[str]:
    """Return a sentence on each choice that nobody made."""
    found: dict[str, list[str]] = {}
    for take in takes:
        if take.track.why:
            found.setdefault(
                f"{take.track.hand} is taken, {take.track.why}; --marker chooses another", []
            ).append(_name(take))
        if not take.motion.up_source:
            found.setdefault(
                f"{take.track.up} is taken as up, which {take.motion.kind} does not state; --up "
                "chooses another",
                [],
            ).append(_name(take))
        if not take.motion.unit:
            found.setdefault(
                f"lengths are taken in {_unit(take)}, which {take.motion.kind} does not state; "
                "--unit chooses another",
                [],
            ).append(_name(take))
    return [
        f"{names[0] if len(names) == 1 else f'{len(names)} recordings'}: {text}."
        for text, names in found.items()
    ]


def _unit(take: Take) -> str:
    return {1.0: "metres", 0.01: "centimetres", 0.001: "millimetres"}.get(
        take.motion.metre, f"{take.motion.metre:g} m"
    )


def takes_json(takes: Sequence[Take]) -> list[dict[str, Any]]:
    """Return the takes for JSON."""
    return [
        {
            "file": str(take.file),
            "kind": take.motion.kind,
            "take": take.motion.take or None,
            "marker": take.track.hand,
            "up": take.track.up,
            "unit": take.motion.unit or None,
            "rate_hz": round(take.rate, 4),
            "gaps_s": [round(gap, 4) for gap in take.gaps],
            "filled": take.filled,
            "left_out": list(take.left_out),
            "lifts": [
                {
                    "trial": lift.trial,
                    "person": lift.person or None,
                    "start_s": round(float(lift.times[0]), 4),
                    "stop_s": round(float(lift.times[-1]), 4),
                    "rise_m": round(lift.rise, 4),
                    "rise_s": round(lift.duration, 4),
                }
                for lift in take.lifts
            ],
        }
        for take in takes
    ]
