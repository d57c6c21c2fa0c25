"""Settings of proximal policy optimisation, readable without JAX."""

import math
from dataclasses import dataclass
from typing import Final

from colift.base.errors import InputError
from colift.benchmark.training.validation import LEARNING_SEEDS

NAME: Final = "ppo"
SELF_PLAY: Final = "self-play"
CO_PLAY: Final = "co-play"
"""Names of the trainers."""

MOST_POPULATION: Final = 100
"""Largest population."""

KEPT: Final = 3
"""Number of people kept from a training: those at its beginning, half-way and at its end."""


@dataclass(frozen=True, kw_only=True)
class PpoSettings:
    """Settings of a training.

    Raises
    ------
    InputError
        If one is out of range.
    """

    updates: int = 120
    """Number of updates, each from newly played lifts."""
    pool: int = 3000
    """Lifts drawn at the beginning. Each has another person."""
    lifts: int = 512
    """Lifts per update. Their people are from the pool."""
    steps: int = 20
    """Steps of the human's motion that the network sees."""
    hidden: int = 64
    """Tanh units of each of its two layers."""
    epochs: int = 4
    """Passes through the lifts of an update."""
    batches: int = 32
    """Steps of the optimiser in a pass."""
    rate: float = 1e-3
    """Initial learning rate; it falls linearly to zero."""
    discount: float = 0.9
    """Weight of the next step's reward. The effect of an action shows within three steps."""
    trace: float = 0.9
    """Weight of the next step in the estimate of an advantage."""
    clip: float = 0.2
    """Largest change of an action's probability that is rewarded, relative to 1."""
    noise: float = 0.3
    """Initial standard deviation of the actions, before the tanh: 0.3 is 9 mm."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        for name in ("updates", "pool", "lifts", "steps", "hidden", "epochs", "batches"):
            if getattr(self, name) < 1:
                raise InputError(f"{name} must be at least 1, got {getattr(self, name)}")
        if self.pool > len(LEARNING_SEEDS):
            raise InputError(f"pool must be at most {len(LEARNING_SEEDS)}, got {self.pool}")
        if self.lifts > self.pool:
            raise InputError(f"lifts must be at most pool, {self.pool}, got {self.lifts}")


@dataclass(frozen=True, kw_only=True)
class SelfPlaySettings(PpoSettings):
    """Settings of a training with a person who also learns; only the bodies of the pool are used.

    Raises
    ------
    InputError
        If one is out of range.
    """

    haste: float = 0.2
    """Cost to the person of the distance from the goal. It is that of a step at 1 cm from it; 1 is
    the cost of a step 1 cm apart."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        super().__post_init__()
        if not 0 < self.haste < math.inf:
            raise InputError(f"haste must be above 0, got {self.haste}")


@dataclass(frozen=True, kw_only=True)
class CoPlaySettings(SelfPlaySettings):
    """Settings of a training with a population; ``updates`` are those of each of its trainings.

    Raises
    ------
    InputError
        If one is out of range.
    """

    population: int = 4
    """Trainings by self-play first; each gives 3 people."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        super().__post_init__()
        if not 1 <= self.population <= MOST_POPULATION:
            raise InputError(f"population must be 1 to {MOST_POPULATION}, got {self.population}")
        people = KEPT * self.population
        if self.lifts < people:
            raise InputError(
                f"lifts must be at least one per person of the population, {people}, got "
                f"{self.lifts}"
            )
        if self.updates < 2:
            raise InputError(
                f"updates must be at least 2, got {self.updates}: people are kept half-way"
            )
