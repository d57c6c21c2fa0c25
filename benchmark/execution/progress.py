"""Worker processes and the progress of long jobs, on stderr: a bar, if that is a terminal."""

import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass

from colift.benchmark.execution.pool import local_pool
from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TaskID,
    TextColumn,
    TimeRemainingColumn,
)
from rich.text import Text


@contextmanager
def workers(
    description: str, total: int | None, jobs: int | None
) -> Iterator[tuple[Executor | None, Callable[[int], None]]]:
    """Start worker processes and show a bar while the body runs.

    Parameters
    ----------
    description, total
        Text and length of the bar.
    jobs
        Number of processes; see :func:`.local_pool`.
    """
    with local_pool(jobs) as pool, progress_bar(description, total) as progress:
        yield pool, progress


@contextmanager
def progress_bar(description: str, total: int | None) -> Iterator[Callable[[int], None]]:
    """Show a bar while the body runs; yield the function that advances it."""
    with job_bar(description, total) as bar:
        yield bar.advance


@dataclass
class JobBar:
    """The progress bar of a job in stages."""

    progress: Progress
    task: TaskID
    words: bool
    """Whether each new stage is also a line on stderr."""
    _told: str = ""

    def stage(self, name: str) -> None:
        """Name the present stage."""
        self.progress.update(self.task, description=name)
        if self.words and name != self._told:
            print(name, file=sys.stderr, flush=True)
        self._told = name

    def note(self, text: str) -> None:
        """Print a line on stderr, above the bar."""
        self.progress.console.print(Text(text), soft_wrap=True)

    def advance(self, done: int) -> None:
        """Advance the bar."""
        self.progress.advance(self.task, done)

    def total(self, total: int) -> None:
        """Set the length of the bar, once it is known."""
        self.progress.update(self.task, total=total)

    def at(self, stage: str, done: int, total: int) -> None:
        """Show the progress of another process."""
        self.progress.update(self.task, completed=done, total=total)
        self.stage(stage)


@contextmanager
def job_bar(description: str, total: int | None, *, words: bool = False) -> Iterator[JobBar]:
    """Show a bar of a job in stages while the body runs.

    With ``words``, each new stage is a line on stderr where there is no terminal for a bar.
    """
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
        task = bar.add_task(description, total=total)
        yield JobBar(bar, task, words and not console.is_terminal)
