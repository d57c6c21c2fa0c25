"""Who plays in a test of admission: policies, their other settings, and what they are blind to."""

from typing import Final

from colift.agents.loading.parameters import parameters_of
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.loading.values import write_value
from colift.base.errors import InputError
from colift.base.registry import POLICIES, entries, made_for

KEEPERS: Final = ("copy", "extrapolate", "anticipate")
"""Policies that keep the table level, from the simplest to the best: players of every task."""

HOLD: Final = "hold"
"""The policy that stands still."""

NO_ATTEMPT: Final = (HOLD, "random")
"""Policies that do not try to do any task."""

FACTORS: Final = (0.5, 2.0)
"""Factors of the first parameter in the other settings of a policy."""


def players(task: str) -> tuple[str, ...]:
    """Return the policies that are played: level-keepers and the task's own.

    Of a task without policies of its own, these are all that play it.
    """
    others = (name for name in made_for(task) if name not in (*KEEPERS, *NO_ATTEMPT))
    return (*KEEPERS, *others)


def acts_alone(name: str) -> bool:
    """Return whether a registered policy is blind to the partner, whom it sees only to keep level.

    A policy for any task is: it reads sight alone, and knows nothing to do but keep level. A policy
    for one task says so by an attribute ``alone``.
    """
    general = entries(POLICIES)[name].group == POLICIES
    return general or bool(getattr(PolicySpec(text=name).load(), "alone", False))


def other_settings(name: str) -> tuple[str, ...]:
    """Return a policy with half and twice its first parameter, as far as it has one and may.

    A gain that is right for everybody on average hides that people differ. Policies that are blind
    to the partner have no other settings.
    """
    if acts_alone(name):
        return ()
    known = parameters_of(PolicySpec(text=name).load())
    numbers = {key: each.default for key, each in known.items() if type(each.default) is float}
    if not numbers:
        return ()
    key, default = next(iter(numbers.items()))
    texts = (f"{name},{key}={write_value(factor * default)}" for factor in FACTORS)
    return tuple(text for text in texts if _allowed(text))


def _allowed(text: str) -> bool:
    try:
        PolicySpec(text=text).check()
    except InputError:
        return False
    return True
