"""The task that a policy is for, by its first step before a lift is played."""

from collections.abc import Iterator
from contextlib import ExitStack, closing
from typing import Final

from colift.agents.spec import AgentSpec, Paced
from colift.base.errors import InputError
from colift.base.registry import TASKS, entries
from colift.benchmark.episode.blame import blaming_plugins, check_start
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.turns import Turns
from colift.benchmark.execution.playing import entered
from colift.benchmark.suites.catalogue import make_scenario

SEED: Final = 0
"""Seed of the lift of which the first step is tried, if no other is given."""

BEHAVIOUR: Final = "smooth"
"""Human behaviour with which the other tasks are tried."""


def check_fits(policy: AgentSpec, scenario: Scenario, seed: int = SEED) -> str | None:
    """Refuse a policy that fails in the first step of a task, but not in that of another.

    A submission does not name its task, but its code or its network may refuse the observations of
    others. A policy that fails in every task is not refused: its failures are its result, and the
    reason of this one is returned; None if it does not fail.

    Raises
    ------
    InputError
        If the policy is for other tasks; the message names them, and the reason of the failure. Or
        if the task or the behaviour of another package failed.
    EvaluatorFault
        If the machine failed.
    """
    reason = _first_failure(policy, scenario, seed)
    others = () if reason is None else tuple(_others(policy, scenario.task.name))
    if others:
        raise InputError(
            f"policy {policy.name!r} is for the task {' or '.join(map(repr, others))}, not for "
            f"{scenario.task.name!r}, where it fails at once: {reason}"
        )
    return reason


def _first_failure(policy: AgentSpec, scenario: Scenario, seed: int) -> str | None:
    """Return the reason why a policy fails before or in its first step; None if it does not.

    Raises
    ------
    EvaluatorFault
        If the machine failed, and not the policy.
    InputError
        If the task or the behaviour of another package failed.
    """
    if isinstance(policy, Paced):
        policy = policy.paced(scenario.control_period)
    with blaming_plugins(scenario, seed), ExitStack() as stack:
        lift = stack.enter_context(closing(Lift(scenario)))
        check_start(lift, seed)
        lift.reset(seed)
        turns = Turns(entered(stack, policy), lift.partner_size)
        turns.start()
        if turns.failure is None:
            turns.ask(lift.partner_observation())
        return turns.failure


def _others(policy: AgentSpec, task: str) -> Iterator[str]:
    """Yield the names of the other tasks in which a policy does not fail at once."""
    for name in entries(TASKS):
        if name == task:
            continue
        try:
            failure = _first_failure(policy, make_scenario(BEHAVIOUR, task=name), SEED)
        except InputError:
            continue  # Another package's task, which cannot be loaded or played.
        if failure is None:
            yield name
