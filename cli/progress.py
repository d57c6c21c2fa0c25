"""The progress bar of long jobs: on stderr, and only on a terminal."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeRemainingColumn,
)


@contextmanager
def progress_bar(description: str, total: int | None) -> Iterator[Callable[[int], None]]:
    """Show a bar while the body runs; the yielded function adds to what is done."""
    with stage_bar(description, total) as (_, progress):
        yield progress


@contextmanager
def stage_bar(
    description: str, total: int | None
) -> Iterator[tuple[Callable[[str], None], Callable[[int], None]]]:
    """Show a bar of a job in stages: the functions tell which it is, and add to what is done."""
    console = Console(stderr=True)
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
    )
    with Progress(
        *columns, console=console, transient=True, disable=not console.is_terminal
    ) as bar:
        task = bar.add_task(description, total=total)
        yield (
            lambda stage: bar.update(task, description=stage),
            lambda done: bar.advance(task, done),
        )
