"""Columns of a table of motion: what their names say of point, axis, unit and time."""

import re
from collections.abc import Sequence
from typing import Final, NamedTuple

from colift.base.errors import InputError
from colift.benchmark.recordings.motion import AXES, LENGTH_NAMES

SECONDS: Final = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds"), 1.0),
    **dict.fromkeys(("ms", "msec", "msecs", "millisecond", "milliseconds"), 1e-3),
    **dict.fromkeys(("us", "µs", "usec", "microsecond", "microseconds"), 1e-6),
    **dict.fromkeys(("ns", "nsec", "nanosecond", "nanoseconds"), 1e-9),
    **dict.fromkeys(("min", "minute", "minutes"), 60.0),
}
"""Names of units of time, in lower case [s]."""

TIMES: Final = frozenset(
    ("time", "times", "t", "timestamp", "timestamps", "time stamp", "stamp", "seconds", "secs")
    + ("sec", "elapsed", "elapsed time", "relative time", "rostime", "datetime", "date time")
    + ("zeit", "temps", "tiempo", "tempo", "header stamp", "capture time", "milliseconds")
    + ("time of day", "uhrzeit", "utc", "utc time", "local time")
    + ("nanoseconds", "microseconds", "unix time", "epoch", "host time", "device time")
)
"""Names of a column of times, in lower case, with blanks for other marks between words."""

FRAMES: Final = frozenset(
    ("frame", "frames", "frame#", "frame number", "frame no", "frame nr", "frame id", "frame idx")
    + ("frame index", "index", "idx", "sample", "samples", "sample number", "nr", "no", "n", "#")
    + ("fr", "", "unnamed: 0", "sub frame", "bodyparts", "sample index", "field", "field#")
)
"""Names of a column of the numbers of frames, in lower case."""

TRIALS: Final = frozenset(
    ("trial", "take", "lift", "recording", "repetition", "rep", "trial name", "take name", "file")
    + ("filename", "file name", "trial id", "sequence", "seq name", "session", "trial number")
)
POINTS: Final = frozenset(
    ("marker", "joint", "body", "segment", "landmark", "bodypart", "keypoint", "point", "label")
    + ("marker name", "joint name", "rigid body", "child frame id", "name", "object", "hand")
)
PEOPLE: Final = frozenset(
    ("person", "subject", "participant", "subject id", "participant id", "person id", "actor")
)

NOT_PLACES: Final = frozenset(
    ("orientation", "rotation", "quaternion", "rot", "quat", "quats", "q", "ori", "orient")
    + (
        "euler",
        "angle",
        "angles",
        "velocity",
        "vel",
        "speed",
        "acceleration",
        "acc",
        "accel",
        "rpy",
    )
    + ("rpy", "gyro", "gyroscope", "force", "forces", "moment", "torque", "angular", "linear")
    + (
        "twist",
        "wrench",
        "mag",
        "magnetometer",
        "covariance",
        "residual",
        "error",
        "jerk",
        "axis",
        "cop",
    )
)
"""Words in the names of columns that have axes and are no positions."""

HEIGHTS: Final = frozenset(
    ("height", "altitude", "elevation", "hauteur", "höhe", "hoehe", "altura")
)
"""Words for the height of a point."""

_BRACKETS = re.compile(r"(.*?)\s*[\[({]\s*([^\])}]*?)\s*[\])}]")
_UNITS = sorted({*LENGTH_NAMES, *SECONDS, "px", "pixel", "pixels", "deg", "rad"}, key=len)
_SUFFIX = re.compile(rf"(.*\S)[_\s]+({'|'.join(map(re.escape, reversed(_UNITS)))})", re.IGNORECASE)
_AFTER = (
    re.compile(r"(.*?)([\s_.:/|\-]*)([xyz])", re.IGNORECASE),
    re.compile(r"(.*?)([\s_.:/|\-]*)[tp]([xyz])", re.IGNORECASE),
)
"""A point and an axis, and the same with the T or P of translation or position between them."""
_BEFORE = re.compile(r"([xyz])(?:[\s_.:/|\-]+(.+)|(\d+))", re.IGNORECASE)
_NUMBERED = re.compile(r"(.*(?:cart|pos|position|xyz|coord|coords|state|loc))[\s_]*([0-3])", re.I)
_WORDS = re.compile(r"[A-ZÄÖÜ]?[a-zäöüß]+|[A-ZÄÖÜ]+(?![a-zäöüß])|\d+")
_PLACE = re.compile(
    r"(?:^|[\s_.:/|\-]+|(?<=[a-z0-9])(?=[PTLC]))"
    r"(?:translation|trans|position|pos|location|loc|coordinates?|coords?|p)$",
    re.IGNORECASE,
)


class Column(NamedTuple):
    """A column of positions."""

    point: str
    """The point; empty if the name has none."""
    axis: int
    """Index of the axis."""
    unit: str
    """The unit, as written; empty if there is none."""


def plain_name(name: str) -> str:
    """Return a name in lower case, with blanks for other marks between its words."""
    return " ".join(re.split(r"[\s_.\-]+", name.strip().strip("%").lower())).strip()


def without_unit(name: str) -> tuple[str, str]:
    """Return the name of a column without its unit, and the unit; empty if there is none."""
    found = _BRACKETS.fullmatch(name.strip()) or _SUFFIX.fullmatch(name.strip())
    return (found[1], found[2]) if found else (name.strip(), "")


def time_unit(name: str) -> float | None:
    """Return the unit [s] of a column of times by its name: 0 without one; None if it is none."""
    base, unit = without_unit(name)
    plain = plain_name(base).lstrip("_ ")
    if plain not in TIMES and not plain.endswith(("header stamp", "timestamp")):
        return None
    if plain_name(name) in SECONDS:
        return SECONDS[plain_name(name)]
    return SECONDS.get(unit.lower(), 0.0)


def place_of(name: str, unit: str = "") -> Column | None:
    """Return what a column of positions is; None if it is no such column.

    Parameters
    ----------
    name
        Its name, such as ``RHand X [mm]``, ``hand_tz``, ``pose.position.y`` or ``height_m``.
    unit
        Its unit, if a row of its own states it.
    """
    base, inside = without_unit(name)
    unit = unit or inside
    words = [word.lower() for word in _WORDS.findall(base)]
    if words and words[-1] in HEIGHTS:
        return Column(_PLACE.sub("", base[: -len(words[-1])].strip(" _.-")), 2, unit)
    found = _axis(base)
    if found is None:
        return None
    point, axis = found
    words = [word.lower() for word in _WORDS.findall(point)]
    if NOT_PLACES.intersection(words):
        return None
    return Column(_PLACE.sub("", point), axis, unit)


def _axis(base: str) -> tuple[str, int] | None:
    """Return the point and the axis in a name without a unit."""
    for form in _AFTER:
        after = form.fullmatch(base)
        if after is None:
            continue
        point, mark, letter = after.groups()
        if not point or mark or (letter.isupper() and (point[-1].islower() or point[-1].isdigit())):
            return point, AXES.index(letter.upper())
    before = _BEFORE.fullmatch(base)
    if before:
        return before[2] or before[3], AXES.index(before[1].upper())
    return None


def places_of(names: Sequence[str], units: Sequence[str], where: str) -> dict[int, Column]:
    """Return the columns of positions of a table, by their index.

    A group of columns with a fourth axis, W, is an orientation. Three columns that are numbered,
    such as ``R-CART1`` to ``R-CART3``, are the axes of a point.

    Parameters
    ----------
    names, units
        Name of each column, and its unit, or empty.
    where
        The file's name, for messages.

    Raises
    ------
    InputError
        If two columns are the same axis of the same point.
    """
    turned = {name.strip()[:-1] for name in names if name.strip().lower().endswith("w")}
    found = {
        i: column
        for i, (name, unit) in enumerate(zip(names, units, strict=True))
        if name.strip()[:-1] not in turned or len(name.strip()) == 1
        if (column := place_of(name, unit)) is not None
    }
    found |= _numbered(names, units, found)
    seen: dict[tuple[str, int], int] = {}
    for i, column in found.items():
        other = seen.setdefault((column.point, column.axis), i)
        if other != i:
            raise InputError(
                f"{where}: the columns {names[other]!r:.40} and {names[i]!r:.40} are the same axis "
                "of the same point: keep that of one marker, or give each marker a name of its own"
            )
    return found


def _numbered(
    names: Sequence[str], units: Sequence[str], found: dict[int, Column]
) -> dict[int, Column]:
    groups: dict[str, dict[int, int]] = {}
    for i, name in enumerate(names):
        match = _NUMBERED.fullmatch(without_unit(name)[0])
        if match and i not in found:
            groups.setdefault(match[1], {})[int(match[2])] = i
    return {
        i: Column(point, axis, units[i] or without_unit(names[i])[1])
        for point, places in groups.items()
        if len(places) == 3 and max(places) - min(places) == 2
        for axis, (_, i) in enumerate(sorted(places.items()))
    }
