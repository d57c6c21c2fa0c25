"""The report of a policy's failures, with the end of its output."""

from collections.abc import Iterator
from typing import Final

from ..benchmark.bundle import one_line
from ..benchmark.execution.runner import Run
from .printing import counted

LINES: Final = 20
"""Lines of the output that are shown."""


def printed_lines(printed: str) -> list[str]:
    """Return the end of a policy's output as indented lines, without control sequences."""
    last = printed.strip().splitlines()[-LINES:]
    return ["it printed:", *(f"    {one_line(line)}" for line in last)] if last else []


def reported_failures(run: Run) -> Iterator[str]:
    """Yield the number of failed lifts of a run, the first with its reason, and its output."""
    failed = [episode for episode in run.episodes if episode.failure is not None]
    if failed:
        first = failed[0]
        count = "counts" if len(failed) == 1 else "count"
        yield (
            f"{len(failed)} of {counted(len(run.episodes), 'lift')} failed and {count} as worst; "
            f"the first, {first.behaviour}/{first.subject} seed {first.seed}: {first.failure}"
        )
        yield from printed_lines(first.log)
