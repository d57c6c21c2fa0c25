"""Requests to a policy for an action, with a time limit."""

import queue
import threading
from dataclasses import dataclass
from typing import Protocol

from colift.agents.actions import checked_action
from colift.agents.agent import Agent, Observation
from colift.agents.hardware.stops import HoldReason
from colift.base.errors import error_text


@dataclass(frozen=True, kw_only=True)
class Decision:
    """Outcome of one request to the policy."""

    action: float | None = None
    """Its change of the hand command [m], or None."""
    hold: HoldReason | None = None
    """Reason for no action."""
    reason: str = ""
    """The policy's error, if it failed."""


class Decider(Protocol):
    """Requests actions from a policy."""

    def decide(self, observation: Observation, budget: float) -> Decision:
        """Return its action, or the reason for none after ``budget`` [s]."""

    def close(self) -> None:
        """End the requests."""


def ask(policy: Agent, observation: Observation) -> Decision:
    """Return the policy's action or its failure; only KeyboardInterrupt passes."""
    try:
        return Decision(action=checked_action("robot", policy.act(observation), 1)[0])
    except (Exception, SystemExit) as error:
        return Decision(hold=HoldReason.POLICY_FAILED, reason=error_text(error))


class Inline:
    """Requests in the caller's thread, without a time limit: for simulated time."""

    def __init__(self, policy: Agent) -> None:
        self._policy = policy

    def decide(self, observation: Observation, budget: float) -> Decision:
        """Return its action or its failure."""
        return ask(self._policy, observation)

    def close(self) -> None:
        """Do nothing: there is no thread to end."""


class Timed:
    """Requests in a separate thread: a late policy does not delay the loop.

    An action that arrives after its budget is discarded, and the policy gets no new request before
    it has answered. Python cannot end a thread: a policy that never answers ends with the process.
    """

    def __init__(self, policy: Agent) -> None:
        self._policy = policy
        self._questions: queue.SimpleQueue[Observation | None] = queue.SimpleQueue()
        self._answers: queue.SimpleQueue[Decision] = queue.SimpleQueue()
        self._busy = False
        threading.Thread(target=self._work, name="policy", daemon=True).start()

    def _work(self) -> None:
        while (observation := self._questions.get()) is not None:
            self._answers.put(ask(self._policy, observation))

    def decide(self, observation: Observation, budget: float) -> Decision:
        """Return its action, its failure, or that it was late."""
        if self._busy and self._answers.empty():
            return Decision(hold=HoldReason.POLICY_BUSY)
        if self._busy:
            self._answers.get()
        self._busy = True
        self._questions.put(observation)
        try:
            answer = self._answers.get(timeout=budget)
        except queue.Empty:
            return Decision(hold=HoldReason.POLICY_LATE)
        self._busy = False
        return answer

    def close(self) -> None:
        """Let the thread end once the policy has answered."""
        self._questions.put(None)
