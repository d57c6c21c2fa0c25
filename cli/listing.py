"""``colift list``: what there is."""

from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from ..agents.humans import SUBJECTS, Subject
from ..agents.registry import HUMANS, POLICIES, entries, lookup, summary
from ..benchmark.suite import SUITES
from .policy_parameters import policy_parameters


def list_all(
    policy: Annotated[
        str | None,
        typer.Argument(help="List its parameters: a name, module:Class or file.py:Class."),
    ] = None,
) -> None:
    """List policies, human behaviours, subjects and suites, one line each."""
    if policy is not None:
        for part in policy_parameters(policy):
            Console().print(part, highlight=False)
        return
    table = Table(show_header=False, box=None, padding=(0, 2, 0, 0))
    table.add_column(style="bold", no_wrap=True)
    table.add_column()
    for title, group in (("Robot policies", POLICIES), ("Human behaviours", HUMANS)):
        table.add_row(f"[underline]{title}[/]")
        for name in entries(group):
            table.add_row(f"  {name}", summary(lookup(group, name)))
    table.add_row("[underline]Subjects[/]")
    for name, subject in SUBJECTS.items():
        table.add_row(f"  {name}", _about(subject))
    table.add_row("  draw-N", "a new person of the same population, drawn with seed N")
    table.add_row("[underline]Suites[/]")
    for name, (line, _) in SUITES.items():
        table.add_row(f"  {name}", line)
    Console().print(table, highlight=False)


def _about(subject: Subject) -> str:
    return (
        f"lifts {1000 * subject.amplitude:.0f} mm in {subject.duration:.2f} s, "
        f"arm {subject.stiffness:.0f} N/m, sees after {1000 * subject.visual_delay:.0f} ms"
    )
