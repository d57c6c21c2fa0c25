"""Parameters of the simulation's step and solver."""

from dataclasses import dataclass
from typing import Final

from colift.agents.agent import FRAME


@dataclass(frozen=True, kw_only=True)
class Physics:
    """Time step and solver of the physics engine.

    Raises
    ------
    ValueError
        If a frame is not a whole number of steps, or the number of iterations is negative.
    """

    step: float = 0.01
    """Physics step [s], chosen by the convergence study (``colift bench --convergence``)."""

    iterations: int = 0
    """Iterations of the sequential-impulse solver per step, for the convergence study; with 0 the
    constraints are solved directly."""

    def __post_init__(self) -> None:
        """Check that the step divides the frame."""
        if self.step <= 0 or abs(FRAME / self.step - round(FRAME / self.step)) > 1e-9:
            raise ValueError(f"step must divide the frame of {FRAME} s, got {self.step} s")
        if self.iterations < 0:
            raise ValueError(f"iterations must be at least 0, got {self.iterations}")

    @property
    def steps_per_frame(self) -> int:
        """Physics steps in one motion-capture frame."""
        return round(FRAME / self.step)


PHYSICS: Final = Physics()
