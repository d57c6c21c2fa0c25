"""``colift list``: policies, behaviours, subjects, tasks and suites."""

from typing import Annotated

import typer
from rich.table import Table

from ..agents.humans import SUBJECTS, Subject
from ..agents.registry import HUMANS, POLICIES, SUITES, TASKS, entries, lookup, summary
from .completion import policies
from .policy_parameters import policy_parameters
from .printing import show


def list_all(
    policy: Annotated[
        str | None,
        typer.Argument(
            help="List its parameters: a name, module:Class, file.py:Class or a folder.",
            autocompletion=policies,
        ),
    ] = None,
) -> None:
    """List policies, human behaviours, subjects, suites and tasks, one line each."""
    if policy is not None:
        show(*policy_parameters(policy))
        return
    table = Table(show_header=False, box=None, padding=(0, 2, 0, 0))
    table.add_column(style="bold", no_wrap=True)
    table.add_column()
    _registered(table, "Robot policies", POLICIES)
    _registered(table, "Human behaviours", HUMANS)
    table.add_row("[underline]Subjects[/]")
    for name, subject in SUBJECTS.items():
        table.add_row(f"  {name}", _about(subject))
    table.add_row("  draw-N", "a new person of the same population, drawn with seed N")
    _registered(table, "Suites", SUITES)
    _registered(table, "Tasks", TASKS)
    show(table)


def _registered(table: Table, title: str, group: str) -> None:
    table.add_row(f"[underline]{title}[/]")
    for name in entries(group):
        table.add_row(f"  {name}", summary(lookup(group, name)))


def _about(subject: Subject) -> str:
    return (
        f"lifts {1000 * subject.amplitude:.0f} mm in {subject.duration:.2f} s, "
        f"arm {subject.stiffness:.0f} N/m, sees after {1000 * subject.visual_delay:.0f} ms"
    )
