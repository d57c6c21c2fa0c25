"""The ways in which people move whom all trainers of a level table learn from."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from colift.agents.humans import Behaviour
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.training.roaming import Roaming
from colift.benchmark.training.unsettled import Unsettled

ROAMING: Final = "roaming"
UNSETTLED: Final = "unsettled"

UNREGISTERED: Final[Mapping[str, Behaviour]] = MappingProxyType(
    {ROAMING: Roaming(), UNSETTLED: Unsettled()}
)
"""Behaviours for training only, by name: they are in no registry, so no suite can have them."""

SETTLED: Final = (*BEHAVIOURS, ROAMING)
"""Behaviours that begin after a second of rest, and end where they began."""

SHARE: Final = 3
"""Lifts with an unsettled hand for every five others."""


def curriculum(unsettled: int) -> tuple[str, ...]:
    """Return the behaviours of people in turn: a lift's seed chooses one.

    Parameters
    ----------
    unsettled
        Lifts with an unsettled hand for each of the :data:`SETTLED`.
    """
    return (*SETTLED, *(UNSETTLED,) * unsettled)


CURRICULUM: Final = curriculum(SHARE)
"""Behaviours of the people from whom policies learn, in turn."""
