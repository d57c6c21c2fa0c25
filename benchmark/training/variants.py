"""The networks that show what there is to infer, and their budget; without JAX."""

from collections.abc import Mapping
from typing import Final, NamedTuple

from colift.benchmark.training.apg_settings import ApgSettings


class Variant(NamedTuple):
    """What a network is told, and where it was trained."""

    sensor: bool = False
    """Whether it is told the ages of the samples and the latency."""
    person: bool = False
    """Whether it is told the behaviour and the person's habits."""
    usual: bool = False
    """Whether it knows no delay but that of the suites without conditions; all else is the
    suite's."""


UPDATES: Final = 1000
"""Updates of each training, unless another number is given."""

USUAL, UNTOLD, TOLD_BOTH = "usual delay", "untold", "told both"

VARIANTS: Final[Mapping[str, Variant]] = {
    USUAL: Variant(usual=True),
    UNTOLD: Variant(),
    "told the sensor": Variant(sensor=True),
    "told the person": Variant(person=True),
    TOLD_BOTH: Variant(sensor=True, person=True),
}
"""The networks; all have the same inputs, of which those that are not told are 0."""


def budget(updates: int | None = None) -> ApgSettings:
    """Return the settings of each training, with so many updates; None is :data:`UPDATES`.

    Raises
    ------
    InputError
        If there is no update.
    """
    many = UPDATES if updates is None else updates
    return ApgSettings(updates=many, lifts=6000, batch=128, units=32)
