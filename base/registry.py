"""Policies, human behaviours, suites, tasks and robots by name.

All of them, colift's own and those of other packages, are entry points:
``name = "module:Class"`` in the group ``colift.policies``, ``colift.humans``, ``colift.tasks`` or
``colift.robots``, or ``name = "module:function"`` in ``colift.suites``. A policy for one task alone
is in the group ``colift.policies.TASK``, one that remembers a person in
``colift.policies.session``. Colift's own are in pyproject.toml.
"""

import functools
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Final

from colift.base.docstrings import plain_text
from colift.base.errors import InputError, Remedy
from colift.base.near_names import near_names

POLICIES: Final = "colift.policies"
REMEMBERING: Final = "colift.policies.session"
"""Policies that are made for sessions, and play single lifts, too."""

HUMANS: Final = "colift.humans"
SUITES: Final = "colift.suites"
TASKS: Final = "colift.tasks"
ROBOTS: Final = "colift.robots"

STANDARD_SUITE: Final = "standard-v1"
"""The suite that is played if none is named."""

LEADING_SUITES: Final = ("robust-v1", STANDARD_SUITE)
"""The suites that lead every list, in this order."""

FEW: Final = 8
"""Number of names that an error lists; of more, it names only those that are near."""

_KIND: Final = {
    POLICIES: "policy",
    HUMANS: "human behaviour",
    SUITES: "suite",
    TASKS: "task",
    ROBOTS: "robot",
}


@functools.cache
def entries(group: str) -> dict[str, EntryPoint]:
    """Return the entry points of a group by name, in the order of their names.

    Policies for one task alone are among the policies. If several packages register a name, the
    first is included here; :func:`entry_of` refuses the name.
    """
    return {name: found[0] for name, found in _registered(group).items()}


def suite_names() -> tuple[str, ...]:
    """Return the names of all suites: :data:`LEADING_SUITES`, then the others by name."""
    known = entries(SUITES)
    leading = [name for name in LEADING_SUITES if name in known]
    return (*leading, *(name for name in known if name not in leading))


def entry_of(group: str, name: str) -> EntryPoint:
    """Return the entry point of a name that :func:`entries` has.

    Raises
    ------
    InputError
        If several packages register the name; the message names them.
    """
    every = _contested(group).get(name)
    if every is not None:
        places = ", ".join(f"{each.value}{_package(each)}" for each in every)
        raise InputError(f"{_KIND[group]} {name!r} is registered {len(every)} times: {places}")
    return entries(group)[name]


@functools.cache
def _contested(group: str) -> dict[str, tuple[EntryPoint, ...]]:
    """Return the entry points of the names that several packages register."""
    return {name: found for name, found in _registered(group).items() if len(found) > 1}


def _registered(group: str) -> dict[str, tuple[EntryPoint, ...]]:
    """Return the different entry points of each name, colift's own first."""
    known = entry_points()
    groups = [each for each in known.groups if each == group or each.startswith(f"{group}.")]
    every = [entry for each in groups for entry in known.select(group=each)]
    found: dict[str, dict[str, EntryPoint]] = {}
    for entry in sorted(every, key=lambda entry: (entry.name, not _is_own(entry), entry.value)):
        found.setdefault(entry.name, {}).setdefault(entry.value, entry)
    return {name: tuple(each.values()) for name, each in found.items()}


def playing(task: str, *, sessions: bool = False) -> dict[str, EntryPoint]:
    """Return the entry points of the policies that play a task: those for any task, and its own.

    With ``sessions``, those that remember a person are among them.
    """
    groups = (POLICIES, f"{POLICIES}.{task}", *((REMEMBERING,) if sessions else ()))
    return {name: each for name, each in entries(POLICIES).items() if each.group in groups}


def policies_by_task() -> dict[str, tuple[str, ...]]:
    """Return the names of the policies that play one task alone, by the task's name."""
    found: dict[str, tuple[str, ...]] = {}
    for name, each in sorted(entries(POLICIES).items()):
        if each.group not in (POLICIES, REMEMBERING):
            task = each.group.removeprefix(f"{POLICIES}.")
            found[task] = (*found.get(task, ()), name)
    return dict(sorted(found.items()))


def remembering() -> tuple[str, ...]:
    """Return the names of colift's own policies that remember a person."""
    return tuple(name for name, each in own_entries(POLICIES).items() if each.group == REMEMBERING)


def own_policies(task: str, *, sessions: bool = False) -> tuple[str, ...]:
    """Return the names of colift's own policies that play a task; see :func:`playing`."""
    own = own_entries(POLICIES)
    return tuple(name for name in playing(task, sessions=sessions) if name in own)


def made_for(task: str, *, sessions: bool = False) -> tuple[str, ...]:
    """Return the names of colift's own policies that are made for a task.

    These are those that play it alone or, of a task without such policies, all that play it.
    """
    own = own_policies(task, sessions=sessions)
    special = tuple(name for name in policies_by_task().get(task, ()) if name in own)
    return special or own


def other_task(policy: str, task: str) -> str | None:
    """Return the task of a registered policy that is not for ``task``; None for all other policies.

    The name may be followed by a comma and parameters.
    """
    name = policy.partition(",")[0]
    entry = entries(POLICIES).get(name)
    if entry is None or name in playing(task, sessions=True):
        return None
    return entry.group.removeprefix(f"{POLICIES}.")


def check_plays(policy: str, task: str) -> None:
    """Raise an InputError if a registered policy is for another task; others pass."""
    own = other_task(policy, task)
    if own is not None:
        raise InputError(
            f"policy {policy!r} is for the task {own!r}, not for {task!r}: choose "
            f"the task {own!r}, or a suite of it"
        )


def own_entries(group: str) -> dict[str, EntryPoint]:
    """Return the entry points of a group that are in colift itself."""
    return {name: entry for name, entry in entries(group).items() if _is_own(entry)}


def _is_own(entry: EntryPoint) -> bool:
    return entry.module.startswith(f"{__package__.partition('.')[0]}.")


def _package(entry: EntryPoint) -> str:
    """Return the package of an entry point, as words to follow its value."""
    return "" if entry.dist is None else f" of the package {entry.dist.name}"


class UnknownNameError(InputError):
    """A name that no package registers."""


def called(group: str, name: str) -> str:
    """Return a registered name in words: its kind, and the class or function it stands for."""
    return f"{_KIND[group]} {name!r} ({entries(group)[name].value})"


def lookup(group: str, name: str) -> Any:
    """Return the class, or the function, that is registered under ``name``.

    Raises
    ------
    UnknownNameError
        If the name is unknown; the message has near names, or all if they are few.
    InputError
        If it cannot be loaded, or several packages register it; the message names the package.
    """
    known = entries(group)
    if name not in known:
        text = f"unknown {_KIND[group]} {name!r}"
        near = near_names(name, known)
        if near:
            text += f"; did you mean {' or '.join(near)}?"
        elif len(known) <= FEW:
            text += f"; known: {', '.join(known)}"
        raise UnknownNameError(text, remedy=Remedy.LIST)
    entry = entry_of(group, name)
    try:
        return entry.load()
    except Exception as error:
        raise InputError(
            f"{called(group, name)}{_package(entry)} cannot be loaded: {type(error).__name__}: "
            f"{error}"
        ) from error


def summary(registered: object) -> str:
    """Return the first line of the docstring of something registered, as shown in lists."""
    return plain_text((registered.__doc__ or "").strip().partition("\n")[0])
