"""The delays and losses of the messages of a link, drawn one after the other."""

import math
from collections.abc import Callable, Iterator
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.links.link import Link
from numpy.typing import NDArray

BLOCK: Final = 128
"""Messages whose delays are drawn at a time."""


def link_delays(link: Link, loss_seed: int, jitter_seed: int) -> Iterator[int | None]:
    """Yield the delay of each message in frames, without end; None if it is lost.

    Parameters
    ----------
    link
        The link.
    loss_seed, jitter_seed
        Seeds of the losses and of the jitter.
    """
    chance = np.random.default_rng(loss_seed)
    jitters = _jitter(link, np.random.default_rng(jitter_seed))
    likely = link.loss
    while True:
        delays = np.floor((link.delay + jitters()) / FRAME + 0.5).astype(int).tolist()
        for frames, share in zip(delays, chance.random(BLOCK).tolist(), strict=True):
            lost = share < likely
            yield None if lost else frames
            likely = 1.0 - link.ends_burst if lost else link.begins_burst


def _jitter(link: Link, rng: np.random.Generator) -> Callable[[], NDArray[np.float64]]:
    """Return a function that draws the jitter of the next :data:`BLOCK` messages [s]."""
    mean, deviation = link.jitter_mean, link.jitter_deviation
    if deviation == 0.0:
        return lambda: np.full(BLOCK, mean)
    spread = (deviation / mean) ** 2
    if link.jitter == "gamma":
        return lambda: rng.gamma(1.0 / spread, mean * spread, BLOCK)
    variance = math.log1p(spread)
    return lambda: rng.lognormal(math.log(mean) - variance / 2, math.sqrt(variance), BLOCK)
