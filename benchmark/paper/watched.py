"""The blend policy, watched: what it saw goes into the trace with what it thought."""

import dataclasses
from dataclasses import dataclass

from ...agents.agent import Action, Agent, Observation, RobotObservation
from ...agents.policies.blend import Blend
from ...agents.policies.in_process import InProcess
from ...agents.policies.loading import source_digest
from ...agents.policies.predictor import PredictorParameters


class Watched:
    """Acts as the blend policy does; its internals also hold the ``sample`` it acted on."""

    def __init__(self, blend: Blend) -> None:
        self._blend = blend

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._blend.reset(seed)

    def act(self, observation: Observation) -> Action:
        """Return the action of the blend policy [m]."""
        self._sample = float(observation[RobotObservation.HUMAN_END])
        return self._blend.act(observation)

    def internals(self) -> dict[str, float]:
        """Return the internals of the blend policy and the sample that was acted on [m]."""
        return {**self._blend.internals(), "sample": self._sample}


@dataclass(frozen=True, kw_only=True)
class WatchedBlend(InProcess):
    """Where the watched blend policy comes from, as :class:`.AgentSpec`."""

    name: str = "blend"
    forgetting: float | None = None
    """phi of eq. 7; the policy's own by default."""

    def check(self) -> None:
        """Accept it: the class is here."""

    def digest(self) -> str:
        """Return the hash of the blend policy's source."""
        return source_digest(Blend)

    def make(self) -> Agent:
        """Return a new policy object."""
        parameters = PredictorParameters()
        if self.forgetting is not None:
            parameters = dataclasses.replace(parameters, forgetting=self.forgetting)
        return Watched(Blend(parameters=parameters))
