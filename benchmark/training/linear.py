"""Learning of the linear forecast: least squares on the hands of the people to learn from."""

from collections.abc import Callable
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.control.linear_forecast import TAPS, LinearForecast
from colift.agents.humans.hand import performed
from colift.agents.senses import MOCAP_NOISE
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.training.data import LOOKS, Timing, scenario
from colift.benchmark.training.population import CURRICULUM
from colift.benchmark.training.validation import LEARNING_SEEDS, learning_seeds
from numpy.typing import NDArray

Array = NDArray[np.float64]

LIFTS: Final = 600
"""Lifts to learn from."""

HORIZONS: Final = tuple(round(0.05 * i, 2) for i in range(1, 12))
"""Horizons of the forecast [s]: for latencies of up to 0.45 s at the benchmark's period."""

ROUNDS: Final = 6
"""Fits, each with the weights of the lifts from the one before; then the weights do not change in
the fourth digit."""


def learn_linear(
    *,
    lifts: int = LIFTS,
    first_seed: int = LEARNING_SEEDS[0],
    progress: Callable[[int], None] = lambda lifts: None,
) -> LinearForecast:
    """Return the forecast with the least mean error on the hands of drawn people.

    The hands move as they do while the table stays level, so no robot has a part in the weights.

    Parameters
    ----------
    lifts
        Their number.
    first_seed
        Seed of the first.
    progress
        Called with the number of lifts that were finished since the last call.

    Raises
    ------
    InputError
        As :func:`.learning_seeds`.
    """
    seeds = learning_seeds(lifts, first_seed)
    changes, rises = [], []
    for seed in seeds:
        some = samples(seed)
        changes.append(some[0])
        rises.append(some[1])
        progress(1)
    weights, errors = fitted(changes, rises)
    return LinearForecast(
        interval=CONTROL_PERIOD,
        horizons=np.array(HORIZONS),
        weights=weights,
        provenance={
            "seeds": [seeds[0], seeds[-1]],
            "behaviours": list(CURRICULUM),
            "samples": sum(map(len, changes)),
            "mean_rmse_mm": [round(1000 * error, 3) for error in errors.tolist()],
        },
    )


def samples(seed: int) -> tuple[Array, Array]:
    """Return past changes (n, TAPS - 1) and coming rises (n, horizons) in the lift of a seed [m].

    Each control period is sampled :data:`.LOOKS` times, with new sensor noise. Before the lift, and
    after it, the hand is at rest.
    """
    moves = scenario(seed, CURRICULUM, Timing())
    plan = moves.human.plan(moves.subject, derive_seed(seed, "linear/plan"))
    hand = performed(moves.subject, plan.target, derive_seed(seed, "linear/hand"))
    period = round(CONTROL_PERIOD / FRAME)
    now = np.arange(0, len(hand), period // LOOKS)[:, np.newaxis]
    rng = np.random.default_rng(derive_seed(seed, "linear/sensor"))
    past = now - period * np.arange(TAPS)
    seen = np.where(past < 0, 0.0, hand[np.maximum(past, 0)])
    seen += rng.normal(0.0, MOCAP_NOISE, seen.shape)
    ahead = now + np.round(np.array(HORIZONS) / FRAME).astype(int)
    rises = hand[np.minimum(ahead, len(hand) - 1)] - seen[:, :1]
    return seen[:, :-1] - seen[:, 1:], rises


def fitted(changes: list[Array], rises: list[Array]) -> tuple[Array, Array]:
    """Return the weights (m, k) with the least mean RMSE of lifts, and that error (m,) [m].

    It is least squares in which each lift counts by the inverse of its error: the minimum of the
    mean of root mean squares, as in the score, instead of that of all squares, in which a few
    quick lifts would decide.

    Parameters
    ----------
    changes
        (n, k) inputs of each lift.
    rises
        (n, m) outcomes of each lift.
    """
    # Without BLAS, whose sums depend on the processor.
    squares = np.array([np.einsum("ni,nj->ij", each, each) for each in changes])
    products = np.array(
        [np.einsum("ni,nj->ij", *both) for both in zip(changes, rises, strict=True)]
    )
    errors = np.ones((len(changes), rises[0].shape[1]))
    for _ in range(ROUNDS):
        whole = np.einsum("lij,lm->mij", squares, 1 / errors)
        mixed = np.einsum("lim,lm->mi", products, 1 / errors)
        weights = np.linalg.solve(whole, mixed[..., np.newaxis])[..., 0]
        errors = np.array(
            [
                np.sqrt(((np.einsum("ni,mi->nm", some, weights) - rise) ** 2).mean(axis=0))
                for some, rise in zip(changes, rises, strict=True)
            ]
        )
    return weights, errors.mean(axis=0)
