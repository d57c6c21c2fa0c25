"""Settings of the trainings from data sets; without JAX, so that commands can show them."""

from dataclasses import dataclass
from typing import Final

from colift.base.errors import InputError

CLONE: Final = "clone"
IQL: Final = "iql"
"""Names of the trainers."""

BLOCK: Final = 500
"""Updates that are made at once."""


def check_updates(updates: int) -> None:
    """Raise an InputError if a number of updates is not a multiple of :data:`BLOCK`."""
    if updates < BLOCK or updates % BLOCK:
        raise InputError(f"updates must be a multiple of {BLOCK}, got {updates}")


@dataclass(frozen=True, kw_only=True)
class CloneSettings:
    """Settings of the training.

    Raises
    ------
    InputError
        If one is out of range.
    """

    data: str = ""
    """Digest of the data."""
    updates: int = 10_000
    """Updates of the networks, a multiple of 500."""
    batch: int = 256
    """Steps of the data in each."""
    rate: float = 1e-3
    """First learning rate of Adam; it falls to zero by a cosine."""
    hidden: tuple[int, ...] = (64, 64)
    """Units of the hidden layers of all networks."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        check_updates(self.updates)


@dataclass(frozen=True, kw_only=True)
class IqlSettings(CloneSettings):
    """Settings of the training.

    Raises
    ------
    InputError
        If one is out of range.
    """

    gamma: float = 0.7
    """Discount per step."""
    expectile: float = 0.9
    """0.5: values of the mean action; 1: of the best. It is called tau in the literature."""
    beta: float = 3.0
    """Weight of better actions; 0 clones. It multiplies an advantage."""
    slow: float = 0.005
    """Share of a network that its slow copy takes over in an update."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        super().__post_init__()
        if not 0 <= self.gamma < 1:
            raise InputError(f"gamma must be in [0, 1), got {self.gamma}")
        if not 0.5 <= self.expectile < 1:
            raise InputError(f"expectile must be in [0.5, 1), got {self.expectile}")
        if not 0 <= self.beta < 100:
            raise InputError(f"beta must be in [0, 100), got {self.beta}")
