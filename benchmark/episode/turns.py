"""A partner's turns in one episode: its actions, its errors in words, its time."""

import time
from typing import Final

from colift.agents.actions import ActionError, checked_action
from colift.agents.agent import Agent, Explaining, Observation, Printing
from colift.base.errors import EvaluatorFault, error_text
from colift.benchmark.episode.seeding import derive_seed

START: Final = "start: "
"""Prefix of a failure's reason if the policy could not be made or reset."""

STEP: Final = "step "
"""Prefix if the policy failed in a step; the reason for a dropped table has neither prefix."""


def is_policy_failure(failure: str | None) -> bool:
    """Return whether an episode ended because its policy failed, and not by a drop."""
    return failure is not None and failure.startswith((START, STEP))


def policy_seed() -> int:
    """Return the seed for resetting a policy: the same in every episode, public or hidden.

    A policy's seed must reveal nothing about the episode. A seed derived from the episode's would:
    the public seeds are few enough to try them all. A policy that wants to vary between episodes
    can use its first observation, which carries the sensors' noise.
    """
    return derive_seed(0, "policy")


class Turns:
    """Requests a partner's actions; an error of the partner ends the turns with a reason.

    Parameters
    ----------
    partner
        The agent at the robot's end.
    size
        Length of its action.
    """

    def __init__(self, partner: Agent, size: int) -> None:
        self._partner = partner
        self._explaining = partner if isinstance(partner, Explaining) else None
        self._size = size
        self.failure: str | None = None
        """Reason why the partner cannot continue; None if it can."""
        self.times: list[float] = []
        """Duration of each turn that returned [s]."""
        self.total = 0.0
        """Duration of the reset and of all turns [s], a failed last one included."""

    def start(self) -> None:
        """Reset the partner.

        Raises
        ------
        EvaluatorFault
            If the partner's machine failed, and not the partner.
        """
        begin = time.perf_counter()
        try:
            self._partner.reset(policy_seed())
        except EvaluatorFault:
            raise
        except (Exception, SystemExit) as error:
            self.failure = f"{START}{error_text(error)}"
        self.total += time.perf_counter() - begin

    def ask(self, observation: Observation) -> tuple[list[float], dict[str, float]] | None:
        """Return the partner's action and its explanation of it, or None if it failed.

        Raises
        ------
        EvaluatorFault
            If the partner's machine failed, and not the partner.
        """
        step = len(self.times)
        begin = time.perf_counter()
        try:
            try:
                chosen = self._partner.act(observation)
            finally:
                self.total += (last := time.perf_counter() - begin)
            self.times.append(last)
            return checked_action("robot", chosen, self._size), self._internals()
        except EvaluatorFault:
            raise
        except (Exception, SystemExit) as error:
            reason = error if isinstance(error, ActionError) else error_text(error)
            self.failure = f"{STEP}{step}: {reason}"
        return None

    def _internals(self) -> dict[str, float]:
        """Return the explanation of the last action; raise if it is not named numbers."""
        if self._explaining is None:
            return {}
        return {str(name): float(value) for name, value in self._explaining.internals().items()}

    def log(self) -> str:
        """Return the partner's printed output, if it is captured."""
        return self._partner.printed if isinstance(self._partner, Printing) else ""
