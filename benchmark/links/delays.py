"""The delays and losses of the messages of a link, drawn one after the other."""

import math
from collections.abc import Callable, Iterator

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.links.link import Link


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
    jitter = _jitter(link, np.random.default_rng(jitter_seed))
    lost = chance.random() < link.loss
    while True:
        frames = math.floor((link.delay + jitter()) / FRAME + 0.5)
        yield None if lost else frames
        lost = chance.random() < (1.0 - link.ends_burst if lost else link.begins_burst)


def _jitter(link: Link, rng: np.random.Generator) -> Callable[[], float]:
    """Return a function that draws a jitter [s]."""
    mean, deviation = link.jitter_mean, link.jitter_deviation
    if deviation == 0.0:
        return lambda: mean
    spread = (deviation / mean) ** 2
    if link.jitter == "gamma":
        return lambda: float(rng.gamma(1.0 / spread, mean * spread))
    variance = math.log1p(spread)
    return lambda: float(rng.lognormal(math.log(mean) - variance / 2, math.sqrt(variance)))
