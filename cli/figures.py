"""``colift figures``: the recorded figures of the documentation."""

import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from textwrap import shorten
from typing import Annotated, Final

import typer
from colift.base.errors import EvaluatorFault, InputError
from colift.benchmark.figures.making import FigureStatus, remake, statuses
from colift.benchmark.figures.registry import clone_folder
from colift.benchmark.tables.printing import left, show, table
from colift.cli.options import check_exclusive

SHOWN: Final = 48
"""Characters of a command in the list of figures; a single figure is listed with all of it."""


def figures(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="NAME", help="Figures; default: all, with --remake those due."),
    ] = None,
    again: Annotated[
        bool,
        typer.Option(
            "--remake",
            help="Run the commands of the named figures, or of those that are due; print the "
            "changes.",
        ),
    ] = False,
    check: Annotated[bool, typer.Option("--check", help="Exit with 1 if a figure is due.")] = False,
    recordings: Annotated[
        list[Path] | None,
        typer.Option(
            metavar="CSV",
            help="Recorded lifts, which colift does not contain; repeatable, in the order in which "
            "the commands name them.",
        ),
    ] = None,
) -> None:
    """List the recorded figures of the documentation, or make them again.

    A figure is due if what it depends on has changed since it was made: a suite, a policy, other
    code, a script, or its command. Figures of a machine's speed are made again only by name.

    Example: colift figures --remake board
    """
    check_exclusive(remake=again, check=check)
    files = recordings or []
    if files and not again:
        raise InputError("--recordings needs --remake")
    for file in files:
        if not file.is_file():
            raise InputError(f"--recordings: there is no file {file}")
    root = clone_folder()
    found = statuses(root)
    unknown = [name for name in names or () if name not in found]
    if unknown:
        raise InputError(f"unknown figure {unknown[0]!r}; figures: {', '.join(found)}")
    chosen = {name: found[name] for name in names or found}
    if again:
        wanted = [each for each in chosen.values() if names or _is_due(each)]
        if not _remake(root, wanted, files):
            raise typer.Exit(1)
        return
    _list(chosen)
    if check and any(map(_is_due, chosen.values())):
        raise typer.Exit(1)


def _is_due(status: FigureStatus) -> bool:
    return status.due and not status.figure.machine


def _list(chosen: Mapping[str, FigureStatus]) -> None:
    commands = [status.figure.command for status in chosen.values()]
    if len(commands) > 1:
        commands = [shorten(command, SHOWN, placeholder=" ...") for command in commands]
    rows = zip(chosen, map(_state, chosen.values()), commands, strict=True)
    show(table("", ("figure", left("state"), left("command")), rows))


def _state(status: FigureStatus) -> str:
    """Return the state of a figure in words: current, or due with the first reason."""
    word = "by name" if status.figure.machine else "due" if status.due else "current"
    if not status.due:
        return word
    first, *more = status.reasons
    return f"{word}: {first}" + (f" and {len(more)} more" if more else "")


def _remake(root: Path, wanted: Iterable[FigureStatus], recordings: Sequence[Path]) -> bool:
    """Make figures again, print the changes of each, and return whether all were made."""
    complete = True
    for status in wanted:
        name = status.figure.name
        try:
            changes = remake(root, status.figure, recordings)
        except InputError as error:
            complete = False
            print(f"{error}: give --recordings", file=sys.stderr)
        except EvaluatorFault as fault:
            complete = False
            print(fault, file=sys.stderr)
        else:
            print("\n".join(changes) or f"{name}: unchanged", flush=True)
    return complete
