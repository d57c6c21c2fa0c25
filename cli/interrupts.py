"""A command that Ctrl-C ends, with a message."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

import typer
from colift.cli.loading import INTERRUPTED


@contextmanager
def reported_interrupt(message: str) -> Iterator[None]:
    """End the command with a message if Ctrl-C is pressed while the body runs."""
    try:
        yield
    except KeyboardInterrupt:
        print(f"interrupted: {message}", file=sys.stderr)
        raise typer.Exit(INTERRUPTED) from None
