"""The end of a policy's output, for the report of its failure."""

from typing import Final

from ..benchmark.bundle import one_line

LINES: Final = 20
"""Lines of the output that are shown."""


def printed_lines(printed: str) -> list[str]:
    """Return the end of a policy's output as indented lines, without control sequences."""
    last = printed.strip().splitlines()[-LINES:]
    return ["it printed:", *(f"    {one_line(line)}" for line in last)] if last else []
