"""Settings of proximal policy optimisation, readable without JAX."""

from dataclasses import dataclass
from typing import Final

from ...agents.errors import InputError
from .validation import LEARNING_SEEDS

NAME: Final = "ppo"


@dataclass(frozen=True, kw_only=True)
class PpoSettings:
    """Settings of a training.

    Raises
    ------
    InputError
        If one is out of range.
    """

    updates: int = 120
    """Times that lifts are played and learned from."""
    pool: int = 3000
    """Lifts that are drawn in the beginning."""
    lifts: int = 512
    """Lifts of an update, chosen from the pool."""
    steps: int = 20
    """Steps of the human's motion that the network sees."""
    hidden: int = 64
    """Tanh units of each of its two layers."""
    epochs: int = 4
    """Passes through what was played."""
    batches: int = 32
    """Steps of the optimiser in a pass."""
    rate: float = 1e-3
    """Learning rate in the beginning; it falls to zero in a line."""
    discount: float = 0.9
    """Weight of the next step's reward. An action shows within three steps."""
    trace: float = 0.9
    """Weight of the next step in the estimate of an advantage."""
    clip: float = 0.2
    """Largest change of an action's probability that is rewarded, relative to 1."""
    noise: float = 0.3
    """Deviation of the actions in the beginning, before the tanh: 0.3 are 9 mm."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        for name in ("updates", "pool", "lifts", "steps", "hidden", "epochs", "batches"):
            if getattr(self, name) < 1:
                raise InputError(f"{name} must be at least 1, got {getattr(self, name)}")
        if self.pool > len(LEARNING_SEEDS):
            raise InputError(f"pool must be at most {len(LEARNING_SEEDS)}, got {self.pool}")
        if self.lifts > self.pool:
            raise InputError(f"lifts must be at most pool, {self.pool}, got {self.lifts}")
