"""Scores whose validity is known."""

from collections.abc import Mapping

import numpy as np
import pytest
from colift.benchmark.statistics import Units
from colift.benchmark.validity.scores import Scores

MEANS = {"a": 4.0, "b": 5.0, "c": 7.0, "d": 10.0, "e": 14.0, "f": 20.0}
"""Mean RMSE of the policies [mm], the best first."""


def scores(
    means: Mapping[str, float],
    *,
    name: str = "suite",
    lifts: int = 40,
    strata: int = 1,
    spread: float = 0.5,
    human_human: float = 8.0,
    seed: int = 1,
) -> Scores:
    """Return scores with exactly these means; policies vary independently from lift to lift."""
    rng = np.random.default_rng(seed)

    def lift_by_lift(mean: float) -> np.ndarray:
        noise = rng.normal(0.0, spread, lifts)
        return mean + noise - noise.mean()

    return Scores(
        name=name,
        digest=f"digest of {name}",
        units=Units.episodes(i % strata for i in range(lifts)),
        errors={policy: lift_by_lift(mean) for policy, mean in means.items()},
        human_human=lift_by_lift(human_human),
        seed=seed,
    )


@pytest.fixture
def suite():
    """A suite on which ``a`` is the best and ``f`` the worst."""
    return scores(MEANS)
