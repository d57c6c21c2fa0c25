"""``colift list``: policies, behaviours, subjects, tasks, suites and channels."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from pathlib import Path
from typing import Annotated

import typer
from rich.console import RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from ..agents.errors import InputError
from ..agents.humans import SUBJECTS, Subject
from ..agents.loading.description import ParameterText, described
from ..agents.loading.loading import PolicySpec
from ..agents.registry import (
    HUMANS,
    POLICIES,
    SUITES,
    TASKS,
    entries,
    lookup,
    policies_by_task,
    summary,
)
from ..agents.sandbox.host.policy import SandboxedPolicy
from ..agents.submissions.manifest import MANIFEST, Manifest
from ..agents.submissions.submission import read_submission
from ..benchmark.channels import CHANNELS
from .completion import policies
from .policies import choose_policy
from .printing import show


def list_all(
    policy: Annotated[
        str | None,
        typer.Argument(
            metavar="POLICY",
            help="List the parameters of this policy: a name, module:Class, file.py:Class or a "
            "submission's folder.",
            autocompletion=policies,
        ),
    ] = None,
) -> None:
    """List policies, human behaviours, subjects, suites, tasks and channels, one line each.

    Exit code 1 if one of them cannot be loaded; its line gives the reason.
    """
    if policy is not None:
        show(*policy_parameters(policy))
        return
    table = Table(show_header=False, box=None, padding=(0, 2, 0, 0))
    table.add_column(style="bold", no_wrap=True)
    table.add_column()
    apart = policies_by_task()
    broken: list[str] = []

    def section(title: str, group: str, names: Iterable[str]) -> None:
        """Add the named entries of a group with their summaries, or the errors of loading them."""
        table.add_row(f"[underline]{title}[/]")
        for name in names:
            try:
                text = Text(summary(lookup(group, name)))
            except InputError as error:
                broken.append(name)
                text = Text(str(error), "red")
            table.add_row(f"  {name}", text)

    own = {*chain.from_iterable(apart.values())}
    section("Robot policies", POLICIES, [each for each in entries(POLICIES) if each not in own])
    for task, names in apart.items():
        section(f"Policies for the task {task}", POLICIES, names)
    section("Human behaviours", HUMANS, entries(HUMANS))
    table.add_row("[underline]Subjects[/]")
    for name, subject in SUBJECTS.items():
        table.add_row(f"  {name}", _about(subject))
    table.add_row("  draw-N", "a new person of the same population, drawn with seed N")
    section("Suites", SUITES, entries(SUITES))
    section("Tasks", TASKS, entries(TASKS))
    table.add_row("[underline]Channels[/]")
    for name, channel in CHANNELS.items():
        table.add_row(f"  {name}", str(channel))
    show(table)
    if broken:
        raise typer.Exit(1)


def _about(subject: Subject) -> str:
    return (
        f"lifts {1000 * subject.amplitude:.0f} mm in {subject.duration:.2f} s, "
        f"arm {subject.stiffness:.0f} N/m, sees after {1000 * subject.visual_delay:.0f} ms"
    )


def policy_parameters(text: str) -> Iterator[RenderableType]:
    """Yield the description of a policy, and its parameters: names, defaults, kinds, meanings.

    A policy of colift is loaded in this process, any other in a sandbox.

    Raises
    ------
    InputError
        If there is no such policy, or it cannot be made.
    """
    policy = choose_policy(text)
    known: Sequence[ParameterText]
    if isinstance(policy, SandboxedPolicy):
        line, known = policy.described()
    else:
        made = PolicySpec(text=text).load()
        line, known = summary(made), described(made)
    folder = Path(PolicySpec(text=text).parts[0])
    if isinstance(policy, SandboxedPolicy) and (folder / MANIFEST).is_file():
        manifest = read_submission(folder).manifest
        yield from _manifest(manifest, policy.digest())
        if manifest.model:
            known = ()  # Those of the policy that runs it are in the manifest.
    else:
        yield Text(f"{line}\n")
    for each in known:
        yield Text.assemble((f"  {each.name}={each.default}", "bold"), (f"  {each.kind}", "dim"))
        if each.meaning:
            yield Padding(Text(each.meaning), (0, 0, 0, 6))
    if known:
        last = f"{known[-1].name}={known[-1].default}"
        place = PolicySpec(text=text).parts[0]
        yield Text(f"\nThese are the defaults. To set one: colift run {place},{last}")
    else:
        yield Text("It has no parameters.")


def _manifest(manifest: Manifest, digest: str) -> Iterator[RenderableType]:
    """Yield the content of a submission's manifest."""
    yield Text(f"{manifest.name} by {', '.join(manifest.authors)}")
    yield Text(manifest.description)
    yield Text(f"Licence {manifest.licence}; trained on: {manifest.trained_on}; digest {digest}\n")
    if manifest.parameters:
        yield Text(f"It sets {manifest.parameters}.")
    if manifest.model:
        view = f", in the view {manifest.view!r}" if manifest.view else ""
        yield Text(f"It is the network {manifest.model}{view}.")
