"""Finding agents by name.

Every agent, ours or a third party's, is found the same way: by an entry point of the group
``colift.policies`` or ``colift.humans``, ``name = "module:Class"``. Ours are in pyproject.toml.
"""

import functools
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Final

from .errors import InputError
from .near_names import did_you_mean

POLICIES: Final = "colift.policies"
HUMANS: Final = "colift.humans"

_KIND: Final = {POLICIES: "policy", HUMANS: "human behaviour"}


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
    """Return the entry points of a group whose classes are in colift itself."""
    known = entries(group)
    return {name: known[name] for name in known if known[name].module.startswith(f"{__package__}.")}


def lookup(group: str, name: str) -> Any:
    """Return the class that is registered under ``name``.

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
        told = f"{type(error).__name__}: {error}"
        raise InputError(f"{_KIND[group]} {name!r} ({known[name].value}) fails: {told}") from error


def summary(agent: type) -> str:
    """Return the first line of an agent's docstring, as shown in lists."""
    return (agent.__doc__ or "").strip().partition("\n")[0]
