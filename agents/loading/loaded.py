"""Colift's policies, with all that they import late: what a fork server loads once for all lifts.

The filters' library takes more than a second to import. Policies import it when they make a
filter, so that whoever only lists them need not wait; in a process for each episode that would be
paid again and again.
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
