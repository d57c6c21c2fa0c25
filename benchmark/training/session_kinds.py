"""The networks that show whether it pays to remember a person, and their budget; without JAX."""

from typing import Final, Literal

from colift.benchmark.training.apg_settings import ApgSettings

Kind = Literal["remember", "forget", "told"]
"""A network that keeps its units from lift to lift; one that does not; one that does not, and is
told the person's habits."""

SESSIONS: Final = "session-v1"
"""The suite whose sessions policies learn from, with other people."""

UPDATES: Final = 1500
"""Updates of each training, unless another number is given."""


def session_budget(updates: int | None = None) -> ApgSettings:
    """Return the settings of each training, with so many updates; None is :data:`UPDATES`.

    Raises
    ------
    InputError
        If there is no update.
    """
    many = UPDATES if updates is None else updates
    return ApgSettings(session="remember", updates=many, lifts=8000, batch=64, units=64, rate=0.002)
