"""The policies of a comparison by the names that its tables use: to be played, or played before."""

import dataclasses
from collections import Counter
from collections.abc import Mapping

from colift.agents.spec import AgentSpec
from colift.benchmark.comparison.stored import Stored


def named_apart(
    specs: Mapping[str, AgentSpec], stored: Mapping[str, Stored]
) -> tuple[dict[str, AgentSpec], list[Stored]]:
    """Return policies by their names, and stored results under theirs.

    Parameters
    ----------
    specs, stored
        Both by the text that a user gave, which takes the place of a name that several have.
    """
    names = Counter(spec.name for spec in specs.values())
    names.update(each.policy.name for each in stored.values())
    called = {spec.name if names[spec.name] == 1 else text: spec for text, spec in specs.items()}
    return called, [
        each
        if names[each.policy.name] == 1
        else dataclasses.replace(each, policy=dataclasses.replace(each.policy, name=text))
        for text, each in stored.items()
    ]
