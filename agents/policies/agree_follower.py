"""The polite follower: lets the human go first, and takes the time that is left."""

from ..agent import Observation
from ..observations import AgreeObservation
from .agree_leader import AgreeLeader

NEEDED = 0.75


class AgreeFollower(AgreeLeader):
    """Keeps level until the last moment at which its own hurdle can be passed."""

    def _mine(self, observation: Observation) -> bool:
        return super()._mine(observation) and bool(
            observation[AgreeObservation.VIA_STOP] < NEEDED
        )
