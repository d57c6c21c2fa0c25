"""Policies, human behaviours, suites and tasks by name.

All of them, colift's own and those of other packages, are entry points:
``name = "module:Class"`` in the group ``colift.policies``, ``colift.humans`` or ``colift.tasks``,
or ``name = "module:function"`` in ``colift.suites``. Colift's own are in pyproject.toml.
"""

import functools
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Final

from .errors import InputError
from .near_names import did_you_mean

POLICIES: Final = "colift.policies"
HUMANS: Final = "colift.humans"
SUITES: Final = "colift.suites"
TASKS: Final = "colift.tasks"

_KIND: Final = {POLICIES: "policy", HUMANS: "human behaviour", SUITES: "suite", TASKS: "task"}


@functools.cache
def entries(group: str) -> dict[str, EntryPoint]:
    """Return the entry points of a group by name, in the order of their names.

    Raises
    ------
    InputError
        If two packages register the same name.
    """
    found: dict[str, EntryPoint] = {}
    for entry in sorted(entry_points(group=group), key=lambda entry: entry.name):
        known = found.setdefault(entry.name, entry)
        if known.value != entry.value:
            raise InputError(
                f"{_KIND[group]} {entry.name!r} is registered twice: {known.value}, {entry.value}"
            )
    return found


def own_entries(group: str) -> dict[str, EntryPoint]:
    """Return the entry points of a group that are in colift itself."""
    own = f"{__package__.partition('.')[0]}."
    return {name: entry for name, entry in entries(group).items() if entry.module.startswith(own)}


def lookup(group: str, name: str) -> Any:
    """Return the class, or the function, that is registered under ``name``.

    Raises
    ------
    InputError
        If the name is unknown; the message lists all names.
    """
    known = entries(group)
    if name not in known:
        near = did_you_mean(name, known)
        raise InputError(f"unknown {_KIND[group]} {name!r}; {near}known: {', '.join(known)}")
    try:
        return known[name].load()
    except Exception as error:
        message = f"{type(error).__name__}: {error}"
        raise InputError(
            f"{_KIND[group]} {name!r} ({known[name].value}) cannot be loaded: {message}"
        ) from error


def summary(registered: object) -> str:
    """Return the first line of the docstring of something registered, as shown in lists."""
    return (registered.__doc__ or "").strip().partition("\n")[0]
