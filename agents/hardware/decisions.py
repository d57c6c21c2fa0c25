"""Asking a policy for an action without ever waiting for it longer than it may take."""

import queue
import threading
from dataclasses import dataclass
from typing import Final, Protocol

from ..actions import checked_action
from ..agent import Agent, Observation
from ..errors import error_text
from .stops import HoldReason

POLICY_SHARE: Final = 0.6
"""Share of the control period that the policy may take: a later answer is thrown away. The rest
is for reading the robot and for the command."""


@dataclass(frozen=True, kw_only=True)
class Decision:
    """Outcome of asking the policy once."""

    action: float | None = None
    """Its change of the hand command [m], or None."""
    hold: HoldReason | None = None
    """Why there is none."""
    reason: str = ""
    """What the policy said, if it failed."""


class Decider(Protocol):
    """Asks a policy."""

    def decide(self, observation: Observation, budget: float) -> Decision:
        """Return its action, or why there is none after ``budget`` [s]."""

    def close(self) -> None:
        """Ask no more."""


def ask(policy: Agent, observation: Observation) -> Decision:
    """Return the policy's action, or how it failed; only what ends the process is let through."""
    try:
        return Decision(action=checked_action("robot", policy.act(observation), 1)[0])
    except (Exception, SystemExit) as error:
        return Decision(hold=HoldReason.POLICY_FAILED, reason=error_text(error))


class Inline:
    """Asks a policy in the caller's thread, however long it takes: for time that is not real."""

    def __init__(self, policy: Agent) -> None:
        self._policy = policy

    def decide(self, observation: Observation, budget: float) -> Decision:
        """Return its action, or how it failed."""
        return ask(self._policy, observation)

    def close(self) -> None:
        """Do nothing: no thread is to be ended."""


class Timed:
    """Asks a policy in a thread of its own, so that a late one cannot hold the loop up.

    An action that comes after its budget is thrown away, and the policy is not asked again before
    it has answered. Python cannot end a thread: one that never answers ends with the process.
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
        """Return its action, or that it failed, or was late."""
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
        """Let the thread end, once the policy has answered."""
        self._questions.put(None)
