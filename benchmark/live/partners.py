"""The holders of the far end in a live lift."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from ...agents.errors import InputError
from ...agents.spec import AgentSpec
from ..results.baselines import PARTNER_SPEC

SIMULATED: Final = "simulated person"
"""The second person of the human-human baseline, simulated."""

PERSON: Final = "person"
"""A second person with arms of flesh."""

PERSON_AS_ROBOT: Final = "person as robot"
"""A second person who commands the NAO."""

LIVE_DIGEST: Final = "live"
"""Stands for a policy's digest where a person acted."""


@dataclass(frozen=True, kw_only=True)
class LivePartner:
    """A holder of the far end."""

    name: str
    seat: str
    """Hands of the far end: a name of :data:`.SEATS`."""
    spec: AgentSpec | None = None
    """The agent; None if a second person acts."""

    @property
    def people(self) -> int:
        """How many real people lift."""
        return 1 if self.spec is not None else 2


def live_partner(name: str, policies: Mapping[str, AgentSpec]) -> LivePartner:
    """Return a partner by the name that pages use.

    Raises
    ------
    InputError
        If there is none of that name; the message lists all.
    """
    if name in policies:
        return LivePartner(name=name, seat="nao", spec=policies[name])
    others = {
        SIMULATED: LivePartner(name=SIMULATED, seat="human", spec=PARTNER_SPEC),
        PERSON: LivePartner(name=PERSON, seat="live"),
        PERSON_AS_ROBOT: LivePartner(name=PERSON_AS_ROBOT, seat="nao"),
    }
    if name not in others:
        known = ", ".join([*policies, *others])
        raise InputError(f"unknown partner {name!r:.80}; known: {known}")
    return others[name]
