"""The progress bar of long jobs: on stderr, and only on a terminal."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TaskID,
    TextColumn,
    TimeRemainingColumn,
)


@contextmanager
def progress_bar(description: str, total: int | None) -> Iterator[Callable[[int], None]]:
    """Show a bar while the body runs; the yielded function adds to what is done."""
    with job_bar(description, total) as bar:
        yield bar.advance


@dataclass(frozen=True)
class JobBar:
    """The bar of a job in stages."""

    progress: Progress
    task: TaskID

    def stage(self, name: str) -> None:
        """Say what is done now."""
        self.progress.update(self.task, description=name)

    def advance(self, done: int) -> None:
        """Add to what is done."""
        self.progress.advance(self.task, done)

    def total(self, total: int) -> None:
        """Say how much there is to do, once that is known."""
        self.progress.update(self.task, total=total)

    def at(self, stage: str, done: int, total: int) -> None:
        """Say how far somebody else is."""
        self.progress.update(self.task, description=stage, completed=done, total=total)


@contextmanager
def job_bar(description: str, total: int | None) -> Iterator[JobBar]:
    """Show a bar of a job in stages while the body runs."""
    console = Console(stderr=True)
    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
    )
    with Progress(
        *columns, console=console, transient=True, disable=not console.is_terminal
    ) as bar:
        yield JobBar(bar, bar.add_task(description, total=total))
