"""Options that commands share: policies, suites, timing, worker processes and files to write."""

import os
import sys
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from contextlib import AbstractContextManager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer
from colift.base.errors import InputError
from colift.base.registry import STANDARD_SUITE
from colift.benchmark.channels import CHANNELS, Channel, make_channel
from colift.benchmark.execution.pool import JOBS, local_pool
from colift.benchmark.rendering.layout import SUFFIXES, Layout, find_layout
from colift.cli.completion import behaviours, channels, layouts, policies, robots, suites
from colift.cli.remedies import naming, opened

# The engine takes a second to import: not for a help text or a completion.
if TYPE_CHECKING:
    from colift.benchmark.suites.suite import Suite

DIGITS: Final = 12
"""Digits of the largest seed."""

MOST: Final = 100_000
"""Largest number of seeds: as many lifts as a result bundle can hold."""

LATENCY_OPTION: Final = typer.Option(metavar="S", help="Age of the robot's data, in seconds.")
PERIOD_OPTION: Final = typer.Option(metavar="S", help="Time between two decisions, in seconds.")

LAYOUT_OPTION: Final = typer.Option(
    "--for",
    metavar="column|page|slide",
    help="Size of figures: a column (3.5 inches), a page (7 inches) or a slide (16:9).",
    autocompletion=layouts,
)

PolicyName = Annotated[
    str,
    typer.Argument(
        metavar="POLICY",
        help="A name from 'colift list', module:Class, file.py:Class or a submission's folder; "
        "parameters follow a comma: NAME,gain=0.5.",
        autocompletion=policies,
    ),
]
SuiteName = Annotated[
    str | None,
    typer.Option(
        "--suite",
        metavar="NAME",
        help=f"Suite of lifts; default: {STANDARD_SUITE}.",
        autocompletion=suites,
    ),
]
Seeds = Annotated[
    str | None, typer.Option(metavar="A:B", help="Seeds A to B-1 instead of the suite's.")
]
Recordings = Annotated[
    Path | None,
    typer.Option(
        metavar="CSV",
        help="Recorded human motion instead of a suite: a file with the columns trial,t_s,z_m, or "
        "the folder of a session of 'colift play'.",
    ),
]
AsTheyWere = Annotated[
    bool,
    typer.Option(
        "--as-recorded",
        help="Play --recordings at their own height and pace, those that the robot's arms reach; "
        "default: scaled to 0.20 m and slowed down.",
    ),
]
InSessions = Annotated[
    bool,
    typer.Option(
        "--session",
        help="Play the --recordings of each person in their order, as one session: a policy may "
        "remember the person.",
    ),
]
RobotName = Annotated[
    str | None,
    typer.Option(
        "--robot",
        metavar="NAME",
        help="Robot at the far end, from 'colift list'; default: nao.",
        autocompletion=robots,
    ),
]
Behaviours = Annotated[
    list[str] | None,
    typer.Option(
        "--behaviour",
        metavar="NAME",
        help="Human behaviour instead of the suite's, from 'colift list'; repeatable.",
        autocompletion=behaviours,
    ),
]
ChannelName = Annotated[
    str | None,
    typer.Option(
        "--channel",
        metavar="NAME|FILE",
        help="Network between the robot and the policy, which delays, loses and reorders messages: "
        f"{', '.join(CHANNELS)}, or a .toml file. Default: none.",
        autocompletion=channels,
    ),
]
PolicyIsolation = Annotated[
    str,
    typer.Option(
        "--isolation",
        metavar="LEVEL",
        help="Isolation of the policy: auto (the strongest sandbox that works here; none for "
        "colift's own policies), none, bubblewrap, landlock or limits.",
    ),
]
Jobs = Annotated[
    int | None,
    typer.Option(
        metavar="N",
        help=f"Worker processes; default: {JOBS} if set, else as many as processors may be used.",
    ),
]
Device = Annotated[
    str | None,
    typer.Option(
        metavar="cpu|gpu",
        help="Device of the twin; default: a GPU if there is one and the extra cuda is installed.",
    ),
]
Dask = Annotated[
    str | None,
    typer.Option(metavar="URL", help="Dask scheduler of a cluster to use: tcp://host:8786."),
]
LayoutName = Annotated[str, LAYOUT_OPTION]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON instead of text.")]


def seed_range(text: str) -> tuple[int, int]:
    """Return A and B of ``A:B``.

    Raises
    ------
    InputError
        If it is not two whole numbers, or they are too large or too far apart.
    """
    start, colon, stop = text.partition(":")
    if not (colon and start.isdecimal() and stop.isdecimal()):
        raise InputError(f"--seeds must be A:B with 0 <= A < B, got {text!r}")
    if len(start) > DIGITS or len(stop) > DIGITS:
        raise InputError(f"--seeds must have at most {DIGITS} digits, got {text!r:.80}")
    if int(stop) - int(start) > MOST:
        raise InputError(f"--seeds must be at most {MOST} seeds, got {text!r}")
    return int(start), int(stop)


def chosen_suite(
    name: str | None,
    seeds: str | None,
    recordings: Path | None,
    behaviours: Sequence[str] | None = None,
    robot: str | None = None,
    *,
    as_recorded: bool = False,
    session: bool = False,
) -> "Suite":
    """Return a suite by name, with the given seeds or behaviours, or the suite of recordings.

    With neither a name nor recordings, it is :data:`.STANDARD_SUITE`. With a robot, it plays with
    that. Recordings are scaled and slowed down unless ``as_recorded``, and independent unless they
    are those of a ``session``.

    Raises
    ------
    InputError
        If there is no such suite or behaviour, or the file or the seeds cannot be used.
    """
    from colift.benchmark.suites.suite import make_suite

    if recordings is None:
        if as_recorded:
            raise InputError("--as-recorded needs --recordings: other lifts have one form")
        if session:
            raise InputError("--session needs --recordings: a suite has sessions, or has none")
        suite = make_suite(name or STANDARD_SUITE)
        if behaviours:
            suite = suite.with_behaviours(list(dict.fromkeys(behaviours)))
        suite = suite.with_robot(robot)
        return suite if seeds is None else suite.with_seeds(*seed_range(seeds))
    if behaviours:
        raise InputError("--behaviour and --recordings exclude each other: people move as recorded")
    if seeds is not None:
        raise InputError("--seeds and --recordings exclude each other: a recording has no seed")
    if name is not None:
        raise InputError("--suite and --recordings exclude each other: recordings are a suite")
    from colift.benchmark.real_lifts.suites import real_lifts

    lifts = real_lifts(recordings, as_recorded=as_recorded, session=session, robot=robot)
    report_notes(recordings)
    if lifts.assumed:
        print(f"{recordings.name}: {lifts.assumed}", file=sys.stderr)
    report_left_out(recordings.name, lifts.left_out)
    return lifts.suite.with_robot(robot)


def check_figure(path: Path | None) -> None:
    """Refuse a file of a figure that cannot be written, before any work is done.

    Raises
    ------
    InputError
        If its suffix is none of a figure, or as :func:`check_output`.
    """
    if path is not None and path.suffix not in SUFFIXES:
        known = ", ".join(SUFFIXES)
        raise InputError(f"cannot write {path}: its suffix must be one of {known}")
    check_output(path)


def chosen_layout(text: str) -> Layout:
    """Return the layout of the option ``--for``.

    Raises
    ------
    InputError
        If there is no such layout.
    """
    with naming("--for"):
        return find_layout(text)


def report_notes(recordings: Path) -> None:
    """Report on stderr the licence and the citation that a file of recordings states."""
    from colift.agents.humans.recording_notes import notes_of

    text = "" if recordings.is_dir() else notes_of(recordings).text()
    if text:
        print(f"{recordings.name}: {text}", file=sys.stderr)


def report_left_out(source: str, left_out: Mapping[str, str]) -> None:
    """Report on stderr the lifts of a source that do not count, with the reasons."""
    for name, reason in left_out.items():
        print(f"{source}: {name} does not count: {reason}", file=sys.stderr)


def chosen_channel(text: str | None) -> Channel | None:
    """Return the channel of an option; None if it is not given.

    Raises
    ------
    InputError
        As :func:`.make_channel`.
    """
    if text is None:
        return None
    with naming("--channel"):
        return make_channel(text)


def check_exclusive(**options: object) -> None:
    """Refuse options that exclude each other.

    Raises
    ------
    InputError
        If more than one is set.
    """
    chosen = [f"--{name.replace('_', '-')}" for name, value in options.items() if value]
    if len(chosen) > 1:
        raise InputError(f"{' and '.join(chosen)} exclude each other: give one")


def executor(jobs: int | None, dask: str | None) -> AbstractContextManager[Executor | None]:
    """Return the executor of the episodes; None is this process.

    Parameters
    ----------
    jobs
        Number of processes; None is :func:`.default_jobs`.
    dask
        Address of a Dask scheduler.

    Raises
    ------
    InputError
        If both are given, or ``jobs`` is not positive.
    """
    if dask is None:
        return local_pool(jobs)
    if jobs is not None:
        raise InputError("--jobs and --dask exclude each other: a cluster has its own workers")
    from colift.benchmark.execution.connecting import dask_pool

    return opened(dask_pool(dask), "--dask")


def check_new_file(path: Path | None, suffix: str | None = None) -> None:
    """Refuse a file that exists or cannot be written, before any work is done.

    Parameters
    ----------
    path
        The file, if any.
    suffix
        The suffix that it must have, in lower or upper case; None is any.

    Raises
    ------
    InputError
        If it exists or has another suffix, or as :func:`check_output`.
    """
    if path is not None and suffix is not None and path.suffix.lower() != suffix:
        raise InputError(f"cannot write {path}: its suffix must be {suffix}")
    check_output(path)
    if path is not None and path.exists():
        raise InputError(f"{path} exists; name a new file")


def write_output(path: Path | None, content: str) -> None:
    """Write the result of a command into the requested file, if any, and report it."""
    if path is not None:
        path.write_text(content, encoding="utf-8")
        print(f"written: {path}")


def check_folder(option: str, folder: Path) -> None:
    """Make the folder that an option names, or refuse it, before any work is done.

    Raises
    ------
    InputError
        If it is a file, or cannot be made or written to.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{option}: {folder} cannot be a folder: {error.strerror}") from error
    if not os.access(folder, os.W_OK):
        raise InputError(f"{option}: {folder} is not writable")


def try_folder(option: str, folder: Path) -> None:
    """Refuse a folder that cannot be made or written to, and leave none that was not there.

    Raises
    ------
    InputError
        As :func:`check_folder`.
    """
    missing = [each for each in (folder, *folder.parents) if not each.exists()]
    check_folder(option, folder)
    with suppress(OSError):  # Another command may have written there.
        for each in missing:
            each.rmdir()


def check_new_folder(option: str, folder: Path | None) -> None:
    """Refuse a folder that is there or cannot be made, before any work is done.

    Raises
    ------
    InputError
        If it is there, or as :func:`check_folder`.
    """
    if folder is None:
        return
    if folder.exists():
        raise InputError(f"{option} must be a new folder, {folder} exists")
    try_folder(option, folder)


def check_output(path: Path | None) -> None:
    """Refuse a file that cannot be written, before any work is done.

    Raises
    ------
    InputError
        If its folder is missing or not writable, or it is itself a folder.
    """
    if path is None:
        return
    if not path.parent.is_dir():
        raise InputError(f"cannot write {path}: there is no folder {path.parent}")
    if path.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
        raise InputError(f"cannot write {path}: it is a folder, or not writable")
