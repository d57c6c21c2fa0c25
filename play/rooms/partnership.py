"""A partner over the lifts of a session: the same object of the policy, which may remember."""

import contextlib
from typing import Final

from colift.agents.agent import Agent
from colift.agents.spec import Paced
from colift.base.errors import EvaluatorFault
from colift.benchmark.execution.playing import entered, in_session
from colift.play.rooms.choice import LivePartner

LIFTS: Final = 10
"""Lifts of a session; the next lift begins a new one."""


class Partnership:
    """The lifts of the same people with the same partner, in a row.

    Parameters
    ----------
    partner
        The holder of the far end.
    period
        Time between the decisions of a policy [s].
    """

    def __init__(self, partner: LivePartner, period: float) -> None:
        self.errors: list[float] = []
        """RMSE of the lifts that counted [mm], in order."""
        self._stack = contextlib.ExitStack()
        self._agent: Agent | None = None
        if partner.spec is not None:
            spec = partner.spec
            spec = spec.paced(period, LIFTS) if isinstance(spec, Paced) else spec
            self._agent = in_session(entered(self._stack, spec))

    @property
    def agent(self) -> Agent | None:
        """The agent; None if a second person acts."""
        return self._agent

    @property
    def over(self) -> bool:
        """Whether all lifts of the session are done."""
        return len(self.errors) >= LIFTS

    def close(self) -> None:
        """End the policy."""
        with contextlib.suppress(EvaluatorFault):
            self._stack.close()
