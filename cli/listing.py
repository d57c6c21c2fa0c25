"""``colift list``: policies, behaviours, subjects, tasks, suites and channels."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from pathlib import Path
from typing import Annotated, Any, Final

import typer
from colift.agents.humans import SUBJECTS, Subject
from colift.agents.loading.description import ParameterText, described
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.sandbox.host.policy import SandboxedPolicy
from colift.agents.submissions.choice import choose_policy
from colift.agents.submissions.manifest import MANIFEST, Manifest
from colift.agents.submissions.submission import read_submission
from colift.base.errors import InputError, Remedy
from colift.base.near_names import near_names
from colift.base.plugins import class_fault
from colift.base.registry import (
    HUMANS,
    POLICIES,
    REMEMBERING,
    ROBOTS,
    SUITES,
    TASKS,
    called,
    entries,
    lookup,
    policies_by_task,
    suite_names,
    summary,
)
from colift.benchmark.channels import CHANNELS
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tables.printing import show
from colift.cli.completion import policies
from rich.console import RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

SECTIONS: Final = ("policies", "behaviours", "subjects", "suites", "tasks", "robots", "channels")
"""What 'colift list' lists, each by the word that lists it alone."""

Section = tuple[str, list[tuple[str, Text]]]
"""A title, and the names below it with a line about each."""


def listed(incomplete: str) -> Iterator[str]:
    """Yield the sections and the policies that begin with a text."""
    yield from (each for each in SECTIONS if each.startswith(incomplete))
    yield from policies(incomplete)


def list_all(
    named: Annotated[
        str | None,
        typer.Argument(
            metavar="SECTION|POLICY",
            help=f"List one section alone: {', '.join(SECTIONS)}. Or list the parameters of this "
            "policy: a name, module:Class, file.py:Class or a submission's folder.",
            autocompletion=listed,
        ),
    ] = None,
) -> None:
    """List policies, human behaviours, subjects, suites, tasks, robots and channels, one line each.

    Exit code 1 if one of them cannot be loaded; its line gives the reason.

    Example: colift list suites
    """
    if named is not None and named not in SECTIONS:
        show(*_policy(named))
        return
    broken: list[str] = []
    table = Table(show_header=False, box=None, padding=(0, 2, 0, 0))
    table.add_column(style="bold", no_wrap=True)
    table.add_column()
    for word in SECTIONS if named is None else (named,):
        for title, lines in _sections(word, broken):
            table.add_row(Text(title, "underline"))
            for name, text in lines:
                table.add_row(Text(f"  {name}"), text)
    show(table)
    if broken:
        raise typer.Exit(1)


def _sections(word: str, broken: list[str]) -> Iterator[Section]:
    """Yield the sections that one of :data:`SECTIONS` lists; add names that cannot be loaded."""
    match word:
        case "policies":
            apart = policies_by_task()
            own = {*chain.from_iterable(apart.values())}
            remembering = [
                each for each, entry in entries(POLICIES).items() if entry.group == REMEMBERING
            ]
            common = [each for each in entries(POLICIES) if each not in {*own, *remembering}]
            yield "Robot policies", _registered(POLICIES, common, broken)
            yield "Policies that remember a person", _registered(POLICIES, remembering, broken)
            for task, names in apart.items():
                yield f"Policies for the task {task}", _registered(POLICIES, names, broken)
        case "behaviours":
            yield "Human behaviours", _registered(HUMANS, entries(HUMANS), broken)
        case "subjects":
            drawn = "a new person of the same population, drawn with seed N"
            people = [(name, Text(_about(subject))) for name, subject in SUBJECTS.items()]
            yield "Subjects", [*people, ("draw-N", Text(drawn))]
        case "suites":
            yield "Suites", _registered(SUITES, suite_names(), broken)
        case "tasks":
            yield "Tasks", _registered(TASKS, entries(TASKS), broken)
        case "robots":
            yield "Robots", _registered(ROBOTS, entries(ROBOTS), broken)
        case "channels":
            yield "Channels", [(name, Text(str(each))) for name, each in CHANNELS.items()]


def _registered(group: str, names: Iterable[str], broken: list[str]) -> list[tuple[str, Text]]:
    """Return the entries of a group with their summaries, or the errors of loading them."""
    lines = []
    for name in names:
        try:
            text = Text(summary(_valid(group, name)))
        except InputError as error:
            broken.append(name)
            text = Text(str(error), "red")
        lines.append((name, text))
    return lines


def _valid(group: str, name: str) -> Any:
    """Return what is registered under a name; raise an InputError if it cannot be used."""
    found = lookup(group, name)
    if group == POLICIES:
        PolicySpec(text=name).load()
    elif group == SUITES:
        make_suite(name)
    elif fault := class_fault(found):
        raise InputError(f"{called(group, name)} {fault}")
    return found


def _policy(text: str) -> list[RenderableType]:
    """Return the description of a policy; the error about an unknown one has a near section."""
    try:
        return list(policy_parameters(text))
    except InputError as error:
        near = near_names(text, SECTIONS, most=1)
        if error.remedy is not Remedy.LIST or not near:
            raise
        raise InputError(f"{error}; or 'colift list {near[0]}'?") from error


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
