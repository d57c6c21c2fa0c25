"""``colift recordings``: lifts from the files of motion capture."""

import re
import sys
from pathlib import Path
from typing import Annotated, Final, NoReturn

import typer
from colift.agents.humans.recording_notes import notes_of
from colift.base.errors import InputError
from colift.benchmark.recordings.columns import SECONDS
from colift.benchmark.recordings.cutting import PHASES, Cut
from colift.benchmark.recordings.motion import LENGTHS, length_of
from colift.benchmark.recordings.takes import Take
from colift.benchmark.recordings.taking import takes_of
from colift.benchmark.recordings.wishes import Wishes
from colift.benchmark.recordings.writing import joined_notes, lifts_csv
from colift.benchmark.tables.printing import counted, show
from colift.cli.document import print_json
from colift.cli.options import AsJson, check_new_file
from colift.cli.remedies import naming
from colift.cli.tables.takes import choices_text, takes_json, takes_table

MOST_PROBLEMS: Final = 12
"""Most refusals that are printed at once."""

WHOLE: Final = "all"
"""The choice of phases that cuts nothing."""

UP: Final = re.compile(r"[+-]?[XYZ]", re.IGNORECASE)

DEFAULTS: Final = Cut()


def make_recordings(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE",
            help="Files of motion capture: Vicon Nexus CSV, Qualisys TSV, Motive CSV, C3D, TRC, "
            "STO, MOT, BVH, AMC, a ROS topic as CSV, or any table of times and positions.",
        ),
    ],
    out: Annotated[
        Path | None,
        typer.Option(metavar="CSV", help="File of lifts to write; without it, show what is there."),
    ] = None,
    marker: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="Marker or joint of the hand; A+B is the middle of two."),
    ] = None,
    far: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="That of the other end of the table, for z_far_m."),
    ] = None,
    up: Annotated[
        str | None,
        typer.Option(metavar="AXIS", help="Axis that points up: X, Y, Z, or -Y if Y points down."),
    ] = None,
    unit: Annotated[
        str | None,
        typer.Option(
            metavar="UNIT",
            help=f"Unit of lengths: {', '.join(LENGTHS)}, or metres per unit, such as 0.002.",
        ),
    ] = None,
    rate: Annotated[
        float | None,
        typer.Option(metavar="HZ", help="Frames per second, counted instead of the file's times."),
    ] = None,
    time_unit: Annotated[
        str | None, typer.Option(metavar="UNIT", help="Unit of times: s, ms, us, ns or min.")
    ] = None,
    between: Annotated[
        str | None,
        typer.Option(metavar="A:B", help="Part to read, in seconds from the first sample."),
    ] = None,
    phases: Annotated[
        str,
        typer.Option(
            metavar="A,B",
            help=f"What is kept of each lift: {PHASES[0]}; {','.join(PHASES[:2])}; "
            f"{','.join(PHASES)}; or {WHOLE}, the recording uncut.",
        ),
    ] = PHASES[0],
    rise: Annotated[
        float, typer.Option(metavar="M", help="Least height of a lift, in metres.")
    ] = DEFAULTS.least,
    pause: Annotated[
        float, typer.Option(metavar="S", help="Longest pause within a rise, in seconds.")
    ] = DEFAULTS.pause,
    margin: Annotated[
        float, typer.Option(metavar="S", help="Most rest to keep before and after, in seconds.")
    ] = DEFAULTS.margin,
    fill: Annotated[
        float, typer.Option(metavar="S", help="Longest gap to fill, in seconds.")
    ] = 0.0,
    leave_out: Annotated[
        bool,
        typer.Option("--leave-out", help="Leave out what cannot be used, and go on with the rest."),
    ] = False,
    person: Annotated[
        str | None,
        typer.Option(metavar="REGEX", help="Part of a file's name that is the person: 'S[0-9]+'."),
    ] = None,
    licence: Annotated[
        str | None, typer.Option(metavar="TEXT", help="Licence of the data, kept in the file.")
    ] = None,
    cite: Annotated[
        str | None, typer.Option(metavar="TEXT", help="Citation of the data, kept in the file.")
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option(metavar="PNG", help="Picture of the lifts; default: beside the CSV file."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Make a file of lifts from the files of motion capture.

    A lift is where the hand rises: from rest, by --rise or more at a speed above 2 cm/s, with
    pauses of up to --pause. Each is cut out with up to --margin of rest on both sides.

    Gaps, clocks that jump, numbers that stand for no value, and people who stand still are refused
    with their place and a way out.

    Example: colift recordings s1/*.c3d --marker RFIN --fill 0.1 --out lifts.csv
    """
    wishes = Wishes(
        hand=marker,
        far=far,
        up=_axis(up),
        unit=unit,
        metre=_length(unit),
        rate=None if rate is None else _positive("--rate", rate),
        second=_second(time_unit),
        between=_part(between),
        fill=_not_negative("--fill", fill),
        person=_pattern(person),
        leave_out=leave_out,
        cut=Cut(
            phases=_phases(phases),
            least=_positive("--rise", rise),
            pause=_not_negative("--pause", pause),
            margin=_not_negative("--margin", margin),
        ),
    )
    with naming("--out"):
        check_new_file(out, ".csv")
    drawn = picture or (out.with_suffix(".png") if out is not None else None)
    with naming("--picture", hint="" if picture else "without it, the picture is beside the lifts"):
        check_new_file(drawn, ".png")
    takes = _takes(files, wishes)
    notes = joined_notes(map(notes_of, files), licence, cite)
    data = lifts_csv(takes, notes)
    made = [] if out is None else [(out, data)]
    if drawn is not None:
        from colift.benchmark.recordings.picture import lifts_png  # Imports matplotlib.

        made.append((drawn, lifts_png(takes)))
    for path, content in made:
        path.write_bytes(content)
    if as_json:
        print_json({"recordings": takes_json(takes), "out": out and str(out)})
        return
    show(takes_table(takes), *choices_text(takes))
    if notes.text():
        show(notes.text())
    _say_next(takes, out, [path for path, _ in made])


def _takes(files: list[Path], wishes: Wishes) -> list[Take]:
    """Return the takes of all files, or refuse all that cannot be used at once."""
    takes: list[Take] = []
    problems: list[str] = []
    for path in files:
        try:
            takes += takes_of(path, wishes)
        except InputError as error:
            problems += str(error).split("\n")
    if problems and not (wishes.leave_out and takes):
        _refuse(problems, len(files))
    for text in (*problems, *(text for take in takes for text in take.left_out)):
        print(f"left out: {text}", file=sys.stderr)
    return takes


def _refuse(problems: list[str], files: int) -> NoReturn:
    """Refuse what cannot be used: one error, or a list of them and their number."""
    if len(problems) == 1:
        raise InputError(problems[0])
    for text in problems[:MOST_PROBLEMS]:
        print(f"refused: {text}", file=sys.stderr)
    raise InputError(
        f"{len(problems)} refusals in {counted(files, 'file')}"
        + (f", the first {MOST_PROBLEMS} are above" if len(problems) > MOST_PROBLEMS else "")
        + ": nothing is written; --leave-out goes on with the rest"
    )


def _say_next(takes: list[Take], out: Path | None, written: list[Path]) -> None:
    lifts = sum(len(take.lifts) for take in takes)
    if written:
        show(f"written: {', '.join(map(str, written))}")
    if out is None:
        nothing = "" if written else "Nothing is written: "
        show(f"{nothing}--out lifts.csv writes the lifts.")
        return
    if lifts > 1:
        show("Next:", f"  colift validity {out}")
    else:
        show("Next (validity needs two lifts or more):", f"  colift run blend --recordings {out}")


def _axis(text: str | None) -> str | None:
    if text is None:
        return None
    if not UP.fullmatch(text):
        raise InputError(f"--up must be X, Y, Z, -X, -Y or -Z, got {text!r:.40}")
    return text.upper().lstrip("+")


def _length(text: str | None) -> float | None:
    metre = None if text is None else length_of(text)
    if text is not None and metre is None:
        raise InputError(
            f"--unit must be one of {', '.join(LENGTHS)}, or a number of metres, got {text!r:.40}"
        )
    return metre


def _second(text: str | None) -> float | None:
    if text is None:
        return None
    if text.lower() not in SECONDS:
        raise InputError(f"--time-unit must be s, ms, us, ns or min, got {text!r:.40}")
    return SECONDS[text.lower()]


def _part(text: str | None) -> tuple[float, float] | None:
    if text is None:
        return None
    try:
        start, stop = (float(part) for part in text.split(":"))
    except ValueError:
        start, stop = 0.0, 0.0
    if not 0.0 <= start < stop:
        raise InputError(f"--between must be A:B in seconds with 0 <= A < B, got {text!r:.40}")
    return start, stop


def _phases(text: str) -> int:
    wanted = tuple(part.strip() for part in text.split(","))
    if wanted == (WHOLE,):
        return 0
    if wanted != PHASES[: len(wanted)]:
        raise InputError(
            f"--phases must be {PHASES[0]}; {','.join(PHASES[:2])}; {','.join(PHASES)}; or "
            f"{WHOLE}, got {text!r:.40}"
        )
    return len(wanted)


def _pattern(text: str | None) -> str | None:
    if text is not None:
        try:
            re.compile(text)
        except re.error as error:
            raise InputError(f"--person is no regular expression: {text!r:.40}: {error}") from None
    return text


def _positive(option: str, value: float) -> float:
    if not 0.0 < value < float("inf"):
        raise InputError(f"{option} must be positive, got {value:g}")
    return value


def _not_negative(option: str, value: float) -> float:
    if not 0.0 <= value < float("inf"):
        raise InputError(f"{option} must not be negative, got {value:g}")
    return value
