"""A channel: the links of messages to a policy and back."""

import dataclasses
from dataclasses import dataclass, field
from typing import Any

from colift.benchmark.links.link import Link


@dataclass(frozen=True, kw_only=True)
class Channel:
    """The network between a robot and its policy: one link for each direction."""

    down: Link = field(default_factory=Link)
    """From the robot to the policy: observations."""
    up: Link = field(default_factory=Link)
    """From the policy to the robot: commands."""

    def plain(self) -> dict[str, Any]:
        """Return all numbers, ready for JSON."""
        return dataclasses.asdict(self)

    def __str__(self) -> str:
        """Return both links in words."""
        if self.down == self.up:
            return f"{self.down}, each way"
        return f"to the policy {self.down}; to the robot {self.up}"
