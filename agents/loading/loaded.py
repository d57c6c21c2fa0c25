"""Colift's policies with their late imports, which a fork server loads once for all lifts.

The library of filters takes more than a second to import. Policies import it when they make a
filter, so that listing policies stays fast; without this module the process of every episode would
import it again.
"""

import filterpy.kalman  # noqa: F401

from ..agent import Agent
from ..registry import POLICIES, own_entries


def __getattr__(name: str) -> type[Agent]:
    """Return the policy class of that name."""
    for entry in own_entries(POLICIES).values():
        if entry.attr == name:
            policy: type[Agent] = entry.load()
            return policy
    raise AttributeError(f"colift has no policy class {name}")
