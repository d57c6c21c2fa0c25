"""The holders of the far end in a live lift, and the host's choice: partner, cues, latency."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from colift.agents.agent import FRAME
from colift.agents.spec import AgentSpec
from colift.base.errors import InputError
from colift.benchmark.episode.scenario import LATENCY, LONGEST_LATENCY
from colift.benchmark.results.baselines import SECOND_PERSON_SPEC
from colift.benchmark.robots.robot import DEFAULT_ROBOT
from colift.play.rooms.scenarios import MIXTURES

SIMULATED: Final = "simulated person"
"""The simulated second of two people."""

PERSON: Final = "person"
"""A second real person, with simulated arms at the far end."""

PERSON_AS_ROBOT: Final = "person as robot"
"""A second person who commands the robot."""

LIVE_DIGEST: Final = "live"
"""Digest that stands in for a policy's where a person acted."""

MIXED: Final = "mixed"


@dataclass(frozen=True, kw_only=True)
class LivePartner:
    """A holder of the far end."""

    name: str
    seat: str
    """Holder of the far end: a robot, or a person of :data:`.HUMANS`."""
    spec: AgentSpec | None = None
    """The agent; None if a second person acts."""

    @property
    def people(self) -> int:
        """Number of real people who lift."""
        return 1 if self.spec is not None else 2


def live_partner(
    name: str, policies: Mapping[str, AgentSpec], robot: str = DEFAULT_ROBOT
) -> LivePartner:
    """Return a partner by the name that pages use; policies move a robot.

    Raises
    ------
    InputError
        If there is none of that name; the message lists all.
    """
    if name in policies:
        return LivePartner(name=name, seat=robot, spec=policies[name])
    others = {
        SIMULATED: LivePartner(name=SIMULATED, seat="human", spec=SECOND_PERSON_SPEC),
        PERSON: LivePartner(name=PERSON, seat="live"),
        PERSON_AS_ROBOT: LivePartner(name=PERSON_AS_ROBOT, seat=robot),
    }
    if name not in others:
        known = ", ".join([*policies, *others])
        raise InputError(f"unknown partner {name!r:.80}; known: {known}")
    return others[name]


@dataclass(frozen=True, kw_only=True)
class HostChoice:
    """The lifts that the people of a room make until the next choice."""

    partner: LivePartner
    mixture: str = MIXED
    """The kind of cues, or ``mixed``."""
    latency: float = LATENCY
    """Age of the motion-capture sample when a robot decides [s]."""

    @classmethod
    def first(cls, policies: Mapping[str, AgentSpec], robot: str = DEFAULT_ROBOT) -> "HostChoice":
        """Return the choice of a new room: the first policy."""
        return cls(partner=live_partner(next(iter(policies)), policies, robot))

    @classmethod
    def parse(
        cls,
        content: Mapping[str, Any],
        policies: Mapping[str, AgentSpec],
        robot: str = DEFAULT_ROBOT,
    ) -> "HostChoice":
        """Return the choice of a page's message.

        Raises
        ------
        InputError
            If the partner or the kind of cues is unknown, or the latency out of range.
        """
        mixture, latency = content.get("kind", MIXED), content.get("latency_ms")
        if mixture not in MIXTURES:
            raise InputError(f"kind must be one of {', '.join(MIXTURES)}, got {mixture!r:.40}")
        if latency is None:
            latency = 1000 * LATENCY
        longest = 1000 * LONGEST_LATENCY
        if not isinstance(latency, int | float) or not 0 <= latency <= longest:
            raise InputError(f"latency_ms must be 0 to {longest:g}, got {latency!r:.40}")
        partner = live_partner(str(content.get("partner")), policies, robot)
        return cls(partner=partner, mixture=mixture, latency=in_frames(latency / 1000))


def in_frames(latency: float) -> float:
    """Return a latency as a whole number of frames [s], at most the longest."""
    return min(round(latency / FRAME) * FRAME, LONGEST_LATENCY)
