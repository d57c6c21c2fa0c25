"""The polite follower: lets the human go first, and takes the time that is left."""

from dataclasses import dataclass

from colift.agents.ranges import Positive
from colift.agents.tasks.agree.agree_leader import AgreeLeader, AgreeLeaderParameters


@dataclass(frozen=True, kw_only=True)
class AgreeFollowerParameters(AgreeLeaderParameters):
    """Parameters of :class:`AgreeFollower`."""

    needed: Positive = 1.0
    """Time that it takes for itself at the end of its window, with the stay [s]."""


class AgreeFollower(AgreeLeader):
    """Keeps level until the last moment at which its own hurdle can be passed; then it leads."""

    def __init__(self, *, parameters: AgreeFollowerParameters | None = None) -> None:
        parameters = parameters or AgreeFollowerParameters()
        super().__init__(parameters=parameters)
        self._needed = parameters.needed

    def _in_turn(self) -> bool:
        return self._hurdle.stop < self._needed
