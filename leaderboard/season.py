"""A season: one suite, one secret; its rows stand in one table and in no other."""

from dataclasses import dataclass, field
from datetime import datetime

from ..benchmark.hidden import commitment, hidden_suite, policy_key
from ..benchmark.suite import Suite


@dataclass(frozen=True, kw_only=True)
class Season:
    """What every submission of a season is evaluated on."""

    name: str
    suite: Suite
    """The public episodes."""
    secret: bytes = field(repr=False)
    """What the hidden episodes follow from."""

    @property
    def commitment(self) -> str:
        """What is published of the secret; see :func:`.commitment`."""
        return commitment(self.secret)

    @property
    def hidden(self) -> Suite:
        """The hidden episodes; see :func:`.hidden_suite`."""
        return hidden_suite(self.suite, self.secret)

    @property
    def policy_key(self) -> bytes:
        """The key of a policy's own seed in the hidden episodes; see :func:`.policy_key`."""
        return policy_key(self.secret)


@dataclass(frozen=True, kw_only=True)
class SeasonInfo:
    """What is published of a season."""

    name: str
    suite: str
    suite_digest: str
    commitment: str
    """SHA-256 of the secret."""
    began_at: datetime
    current: bool
    """Whether it takes submissions; all others are frozen."""
    revealed: str | None
    """The secret, 64 hexadecimal digits, if it has been published: anybody can then play the
    hidden episodes, and check the commitment."""
