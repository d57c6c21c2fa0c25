"""The figures of ``colift bench``: what each means, and the bar that it has to keep."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True, kw_only=True)
class Figure:
    """A figure's meaning and bar."""

    meaning: str
    least: float | None = None
    """Smallest value that keeps the bar; None if it has none."""
    most: float | None = None
    """Largest value that keeps the bar; None if it has none."""

    @property
    def bar(self) -> str:
        """The bar in words; empty if there is none."""
        least = "" if self.least is None else f"at least {self.least:g}"
        return least if self.most is None else f"at most {self.most:g}"

    def kept(self, value: float) -> bool:
        """Return whether a value keeps the bar; one that is not a number does not."""
        return (self.least is None or value >= self.least) and (
            self.most is None or value <= self.most
        )


FIGURES: Final[Mapping[str, Figure]] = {
    "sim_speed": Figure(meaning="simulated seconds per wall second, one process"),
    "naive_nao_ratio": Figure(
        meaning="speed over the whole NAO as loaded, stepped at 240 Hz", least=24
    ),
    "reset_share": Figure(meaning="share of an episode's wall time spent on its reset", most=0.02),
    "solver_error": Figure(
        meaning="worst RMSE error of a lift, relative, to a converged solver", most=0.003
    ),
    "two_workers_ratio": Figure(meaning="throughput of two workers over one", least=1.7),
    "memory_growth_mb": Figure(meaning="growth of the process after the first hundred episodes"),
    "late_over_early": Figure(
        meaning="time of the last episodes over that of the first (1 = linear cost)"
    ),
    "dask_ratio": Figure(
        meaning="throughput of Dask on this machine over the local pool's", least=0.8
    ),
    "verify_ratio": Figure(meaning="throughput of verification over that of the run", least=1),
    "twin_mean_error": Figure(
        meaning="largest error of a policy's mean RMSE in the twin", most=0.001
    ),
    "twin_worst_error": Figure(meaning="largest error of a lift's RMSE in the twin", most=0.01),
    "twin_speed_ratio": Figure(meaning="control steps/s of the twin over the engine's", least=500),
    "twin_gradient_ratio": Figure(meaning="the same of lifts with their gradient", least=50),
    "twin_environment_ratio": Figure(meaning="the same of the environment's steps", least=200),
    "twin_bulk_ratio": Figure(meaning="lifts drawn in bulk over those drawn one by one", least=15),
}


def missed(figures: Mapping[str, float]) -> list[str]:
    """Return each figure that misses its bar, with both."""
    return [
        f"{name} is {value:.3g}, must be {FIGURES[name].bar}"
        for name, value in figures.items()
        if not FIGURES[name].kept(value)
    ]
