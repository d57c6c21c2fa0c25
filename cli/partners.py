"""Policies that people can lift with in the browser."""

import sys
from collections.abc import Mapping

from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.spec import AUTO, AgentSpec
from colift.agents.submissions.choice import checked_policy, choose_policy
from colift.base.errors import EvaluatorFault, InputError
from colift.base.registry import other_task, playing, summary
from colift.benchmark.execution.fitting import check_fits
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.level.task import LEVEL

FIRST = "anticipate"
"""The default partner."""

Partners = tuple[dict[str, AgentSpec], dict[str, str]]
"""Policies by name, and a line about each of them."""


def partners(first: str = FIRST, isolation: str = AUTO) -> Partners:
    """Return a policy, then all registered ones, with a line about each.

    Policies of other packages act in a sandbox; one that cannot is left out and reported on stderr.

    Parameters
    ----------
    first
        The policy as a user names it; see :func:`.checked_policy`.
    isolation
        Its isolation.

    Raises
    ------
    InputError
        If there is no such policy or isolation, or the policy cannot lift a level table.
    """
    own = other_task(first, LEVEL.name)
    if own is not None:
        raise InputError(
            f"policy {first!r} is for the task {own!r}: people lift with policies for the task "
            f"{LEVEL.name!r}"
        )
    chosen = checked_policy(first, isolation)
    _check_lifts(chosen)
    found: dict[str, AgentSpec] = {chosen.name: chosen}
    for name in playing(LEVEL.name, sessions=True):
        if name in found:
            continue
        try:
            found[name] = choose_policy(name)
        except (InputError, EvaluatorFault) as error:
            print(f"{name} cannot be a partner: {error}", file=sys.stderr)
    return found, _lines(found)


def _check_lifts(policy: AgentSpec) -> None:
    """Refuse a policy that fails in the first step of a lift: nobody could lift with it."""
    reason = check_fits(policy, make_scenario("smooth"))
    if reason is not None:
        raise InputError(f"policy {policy.name!r} cannot be a partner: {reason}")


def _lines(found: Mapping[str, AgentSpec]) -> dict[str, str]:
    """Return a line about each policy whose code may be loaded here."""
    return {
        name: summary(spec.load()) for name, spec in found.items() if isinstance(spec, PolicySpec)
    }
