"""Lifts by a formula, as the programs of laboratories write them, in the dialects that occur."""

from dataclasses import dataclass
from itertools import chain

import numpy as np
from colift.agents.estimators.minimum_jerk import profile

METRES = {"mm": 0.001, "cm": 0.01, "m": 1.0}


@dataclass(frozen=True)
class Dialect:
    """The choices of a program, a locale and an editor."""

    delimiter: str = ","
    decimal: str = "."
    newline: str = "\n"
    encoding: str = "utf-8"
    unit: str = "mm"
    first_frame: int = 1
    titled: bool = True
    blank_lines: int = 0

    def text(self, rows):
        """Return rows of cells as the bytes of a file."""
        lines = [self.delimiter.join(row) for row in rows]
        text = self.newline.join([*([""] * self.blank_lines), *lines, ""])
        return text.encode(self.encoding)

    def number(self, value, digits=6):
        """Return a number as text; empty if it is NaN."""
        return "" if np.isnan(value) else f"{value:.{digits}f}".replace(".", self.decimal)


def lift(rate=100.0, *, base=0.9, top=0.3, start=1.5, rise=1.2, lower=True, duration=6.0):
    """Return times [s] and heights [m] of a hand that rises, waits, and comes back."""
    times = np.arange(round(duration * rate)) / rate
    heights = base + top * profile(np.clip((times - start) / rise, 0.0, 1.0))
    if lower:
        heights = heights - top * profile(np.clip((times - start - rise - 0.8) / 1.2, 0.0, 1.0))
    return times, heights


def points(heights, up, names):
    """Return points by name, shape (n, 3) [m]: the first is the hand, the others rest."""
    placed = {}
    for i, name in enumerate(names):
        place = np.tile([0.21 + 0.1 * i, -0.35, 0.4], (len(heights), 1))
        place[:, "XYZ".index(up)] = heights if i == 0 else 0.5
        placed[name] = place
    return placed


def vicon(times, placed, dialect, rate):
    each = [axis for _ in placed for axis in "XYZ"]
    rows = [
        ["Trajectories"],
        [f"{rate:g}".replace(".", dialect.decimal)],
        ["", "", *chain.from_iterable((f"Anna:{name}", "", "") for name in placed)],
        ["Frame", "Sub Frame", *each],
        ["", "", *["mm" for _ in each]],
    ]
    for i in range(len(times)):
        cells = [dialect.number(1000 * v, 4) for place in placed.values() for v in place[i]]
        rows.append([str(dialect.first_frame + i), "0", *cells])
    devices = [["Devices"], ["1000"], ["", "", "Force", "", ""], ["Frame", "Sub Frame", "Fx"]]
    return dialect.text([*rows, [""], *devices, ["", "", "N"], ["1", "0", "3"]])


def qualisys(times, placed, dialect, rate):
    rows = [
        ["NO_OF_FRAMES", str(len(times))],
        ["NO_OF_MARKERS", str(len(placed))],
        ["FREQUENCY", f"{rate:g}"],
        ["TIME_STAMP", "2025-03-11, 10:11:12.000"],
        ["DATA_INCLUDED", "3D"],
        ["MARKER_NAMES", *placed],
        ["TRAJECTORY_TYPES", *["Measured" for _ in placed]],
    ]
    if dialect.titled:
        titles = [f"{name} {axis}" for name in placed for axis in "XYZ"]
        rows.append(["Frame", "Time", *titles])
    for i, time in enumerate(times):
        cells = [dialect.number(1000 * v, 3) for place in placed.values() for v in place[i]]
        before = [str(i + 1), dialect.number(time, 5)] if dialect.titled else []
        rows.append([*before, *cells])
    return dialect.text(rows)


def motive(times, placed, dialect, rate):
    unit = {"mm": "Millimeters", "cm": "Centimeters", "m": "Meters"}[dialect.unit]
    settings = ["Format Version", "1.25", "Take Name", "take", "Export Frame Rate", f"{rate:f}"]
    each = [name for name in placed for _ in range(3)]
    label = (lambda text: ["", text]) if dialect.titled else (lambda text: ["", ""])
    rows = [
        [
            *settings,
            "Rotation Type",
            "Quaternion",
            "Length Units",
            unit,
            "Coordinate Space",
            "Global",
        ],
        [""],
        [*label("Type"), *["Marker" for _ in each]],
        [*label("Name"), *[f"Set:{name}" for name in each]],
        [*label("ID"), *["A1" for _ in each]],
        ["", "", *["Position" for _ in each]],
        ["Frame", "Time (Seconds)", *["XYZ"[i % 3] for i in range(len(each))]],
    ]
    for i, time in enumerate(times):
        scale = METRES[dialect.unit]
        cells = [dialect.number(v / scale) for place in placed.values() for v in place[i]]
        rows.append([str(i), dialect.number(time), *cells])
    return dialect.text(rows)


def trc(times, placed, dialect, rate):
    keys = ["DataRate", "CameraRate", "NumFrames", "NumMarkers", "Units", "OrigDataRate"]
    hertz = dialect.number(rate, 2)
    rows = [
        ["PathFileType", "4", "(X/Y/Z)", "lift.trc"],
        keys,
        [hertz, hertz, str(len(times)), str(len(placed)), dialect.unit, hertz],
        ["Frame#", "Time", *chain.from_iterable((name, "", "") for name in placed)],
        ["", "", *[f"{axis}{i}" for i in range(1, len(placed) + 1) for axis in "XYZ"]],
        *([[""]] if dialect.titled else []),
    ]
    for i, time in enumerate(times):
        scale = METRES[dialect.unit]
        cells = [dialect.number(v / scale) for place in placed.values() for v in place[i]]
        rows.append([str(i + 1), dialect.number(time), *cells])
    return dialect.text(rows)


def sto(times, placed, dialect, rate):
    suffix = ("_tx", "_ty", "_tz") if dialect.titled else ("_X", "_Y", "_Z")
    titles = ["time", *[f"{name}{axis}" for name in placed for axis in suffix], "elbow_flexion"]
    rows = [
        ["lift"],
        ["version=1"],
        [f"nRows={len(times)}"],
        ["inDegrees=yes"],
        ["endheader"],
        titles,
    ]
    for i, time in enumerate(times):
        cells = [f"{v:14.8f}" for place in placed.values() for v in place[i]]
        rows.append([f"{time:14.8f}", *cells, "12.0"])
    return dialect.text(rows)


def bvh(times, placed, dialect, rate):
    (hand, *_), place = placed, next(iter(placed.values()))
    head = (
        f"HIERARCHY\nROOT Hips\n{{\n\tOFFSET 0 0 0\n\tCHANNELS 6 Xposition Yposition Zposition "
        f"Zrotation Xrotation Yrotation\n\tJOINT {hand}\n\t{{\n\t\tOFFSET 0 10 0\n\t\tCHANNELS 3 "
        "Zrotation Xrotation Yrotation\n\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 5 0\n\t\t}\n\t}\n}\n"
        f"MOTION\nFrames: {len(times)}\nFrame Time: {1 / rate:.8f}\n"
    )
    rows = [
        " ".join(f"{v:.6f}" for v in (*(100 * place[i] - [0, 10, 0]), 0, 0, 0, 0, 0, 0))
        for i in range(len(times))
    ]
    return (head + "\n".join(rows) + "\n").replace("\n", dialect.newline).encode(dialect.encoding)


def rostopic(times, placed, dialect, rate):
    place = next(iter(placed.values()))
    axes = [f"field.pose.position.{axis}" for axis in "xyz"]
    rows = [["%time", "field.header.seq", "field.header.stamp", *axes, "field.pose.orientation.w"]]
    for i, time in enumerate(times):
        stamp = 1741687872123456789 + round(1e9 * time)
        rows.append([str(stamp + 3), str(i), str(stamp), *[f"{v:.7f}" for v in place[i]], "1.0"])
    return dialect.text(rows)


def plain(times, placed, dialect, rate):
    unit = dialect.unit
    titles = [f"{name} {axis} [{unit}]" for name in placed for axis in "XYZ"]
    rows = [["Time [s]", *titles]]
    for i, time in enumerate(times):
        scale = METRES[unit]
        cells = [dialect.number(v / scale, 7) for place in placed.values() for v in place[i]]
        rows.append([dialect.number(time), *cells])
    return dialect.text(rows)


def long(times, placed, dialect, rate):
    rows = [["trial", "marker", "t_s", "x_m", "y_m", "z_m"]]
    for i, time in enumerate(times):
        for name, place in placed.items():
            cells = [dialect.number(v, 7) for v in place[i]]
            rows.append(["Prüfung 1", name, dialect.number(time), *cells])
    return dialect.text(rows)
