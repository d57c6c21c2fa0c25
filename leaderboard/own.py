"""The project's own policies as entrants: evaluated like anybody's, in the sandbox."""

import dataclasses
import hashlib
from typing import Final

from ..agents.errors import InputError
from ..agents.isolation.ladder import strongest
from ..agents.isolation.sandboxed import SandboxedPolicy
from ..agents.policies.loading import PolicySpec
from ..agents.registry import POLICIES, lookup, own_entries, summary
from .evaluation import Entrant

LOADED: Final = f"{PolicySpec.__module__.rpartition('.')[0]}.loaded"
"""Module of all policies; see :mod:`colift.agents.policies.loaded`."""

AUTHORS: Final = ("The colift developers",)


def own_names() -> tuple[str, ...]:
    """Return the names of the project's policies."""
    return tuple(own_entries(POLICIES))


def own_entrant(name: str) -> Entrant:
    """Return one of the project's policies as an entrant, as isolated as this machine can.

    Its digest is over its name and the source of all policies, which build on each other.

    Raises
    ------
    InputError
        If the project has no policy of that name.
    """
    entries = own_entries(POLICIES)
    if name not in entries:
        raise InputError(f"colift has no policy {name!r} of its own; it has {', '.join(entries)}")
    source = PolicySpec(text=name).digest()
    policy = SandboxedPolicy(
        name=name,
        place=f"{LOADED}:{entries[name].attr}",
        source_digest=source,
        preload=True,
        rung=strongest(),
    )
    return Entrant(
        name=name,
        authors=AUTHORS,
        description=summary(lookup(POLICIES, name)),
        link="",
        digest=hashlib.sha256(f"colift's own {name}, source {source}".encode()).hexdigest(),
        policy=policy,
        fresh=dataclasses.replace(policy, preload=False),
    )
