"""Conditions of a lift that are drawn with it: the sensor's delays and noise, the table, the arms.

A robot is told none of them.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, fields
from itertools import islice
from types import MappingProxyType
from typing import Any, Final, NamedTuple

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.links.delays import link_delays
from colift.benchmark.links.link import Link
from colift.benchmark.world.interface import HISTORY_FRAMES
from colift.benchmark.world.table import TABLE_MASS, Table
from numpy.typing import NDArray

Range = tuple[float, float]

OLDEST: Final = HISTORY_FRAMES - 1
"""Largest age of a sample in frames: an older one is replaced by one of this age."""

LIMITS: Final[Mapping[str, Range]] = MappingProxyType(
    {
        "latency": (0.0, 0.49),
        "jitter": (0.0, 0.2),
        "loss": (0.0, 0.5),
        "burst": (1.0, 50.0),
        "noise": (0.1, 10.0),
        "table": (0.1, 1.0),
        "stiffness": (0.5, 2.0),
        "damping": (0.5, 2.0),
        "sag": (0.25, 4.0),
        "gain": (0.25, 1.25),
    }
)
"""Limits of each range, in its unit."""


class Drawn(NamedTuple):
    """The conditions of one lift."""

    ages: NDArray[np.int64]
    """(steps + 1,) age in frames of the sample that the robot sees at the beginning of each step,
    and at the end."""
    noise: float
    """Error of the motion capture relative to the benchmark's."""
    table: Table
    """The table."""
    stiffness: float
    """Stiffness of the person's arms relative to the subject's."""
    damping: float
    """Their damping, likewise."""
    sag: float
    gain: float
    """Factors of the robot's arms; see :class:`.Adjustable`."""
    latency: float
    """Shortest delay of a sample [s]; for those who know it."""


@dataclass(frozen=True, kw_only=True)
class Conditions:
    """Ranges of the conditions that are drawn for each lift, independently and evenly.

    The motion capture takes a sample in each frame and sends it to the robot. A sample arrives
    after ``latency`` plus a jitter, unless it is lost (:class:`.Link`); when the robot decides, it
    sees the newest sample that has arrived. A loss is a dropout of the sensor: a marker is hidden,
    or the network is busy, for ``burst`` frames on average.

    Factors are drawn evenly in their logarithm.

    Raises
    ------
    InputError
        If a range is empty or goes beyond :data:`LIMITS`.
    """

    latency: Range = (0.1, 0.1)
    """Shortest delay of a sample [s]."""
    jitter: Range = (0.0, 0.0)
    """Mean and deviation of the additional delay, which is exponential [s]."""
    loss: Range = (0.0, 0.0)
    """Share of the samples that are lost."""
    burst: Range = (1.0, 1.0)
    """Mean number of samples that are lost in a row; at least ``loss / (1 - loss)``."""
    noise: Range = (1.0, 1.0)
    """Factor of the motion capture's error."""
    table: Range = (TABLE_MASS, TABLE_MASS)
    """Mass of the table [kg]."""
    stiffness: Range = (1.0, 1.0)
    """Factor of the stiffness of the person's arms: people tense them more or less."""
    damping: Range = (1.0, 1.0)
    """Factor of their damping."""
    sag: Range = (1.0, 1.0)
    """Factor of the sag of the robot's arms; a robot that is not :class:`.Adjustable` keeps its
    arms."""
    gain: Range = (1.0, 1.0)
    """Factor of the gain of the robot's joints in a frame; below 1, the arms are slower."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        for name, (lowest, highest) in LIMITS.items():
            low, high = getattr(self, name)
            if not lowest <= low <= high <= highest:
                raise InputError(
                    f"the range of {name} must be (low, high) from {lowest:g} to {highest:g}, got "
                    f"({low:g}, {high:g})"
                )
        if self.loss[1] > self.burst[0] * (1.0 - self.loss[1]):
            least = self.loss[1] / (1.0 - self.loss[1])
            raise InputError(
                f"the range of burst must be from {least:g} up with losses of up to "
                f"{self.loss[1]:g}, got ({self.burst[0]:g}, {self.burst[1]:g})"
            )

    def draw(self, seed: Callable[[str], int], steps: int, size: int) -> Drawn:
        """Return the conditions of a lift.

        Parameters
        ----------
        seed
            Returns the lift's seed of a role.
        steps, size
            Steps of the lift, and frames in each.
        """
        own = seed("conditions")
        shares = np.random.default_rng(own).random(len(LIMITS)).tolist()
        share = dict(zip(LIMITS, shares, strict=True))

        def even(name: str) -> float:
            low, high = getattr(self, name)
            return float(low + (high - low) * share[name])

        def factor(name: str) -> float:
            low, high = getattr(self, name)
            return math.exp(math.log(low) + math.log(high / low) * share[name])

        jitter = even("jitter")
        link = Link(
            delay=even("latency"),
            jitter_mean=jitter,
            jitter_deviation=jitter,
            loss=even("loss"),
            burst=even("burst"),
        )
        return Drawn(
            ages=sample_ages(link, steps, size, own),
            noise=factor("noise"),
            table=Table(even("table")),
            stiffness=factor("stiffness"),
            damping=factor("damping"),
            sag=factor("sag"),
            gain=factor("gain"),
            latency=link.delay,
        )

    def plain(self) -> dict[str, list[float]]:
        """Return the ranges by name, ready for JSON."""
        return {name: list(map(float, limits)) for name, limits in asdict(self).items()}

    def __str__(self) -> str:
        """Return the ranges that differ from the defaults in words."""
        own = {each.name: getattr(self, each.name) for each in fields(self)}
        return ", ".join(
            f"{name} {low:g}" if low == high else f"{name} {low:g} to {high:g}"
            for name, (low, high) in own.items()
            if (low, high) != getattr(Conditions, name)
        )


def read_conditions(content: Mapping[str, Any], where: str) -> Conditions:
    """Return the conditions from the content of :meth:`.Conditions.plain`.

    Raises
    ------
    InputError
        If a range is missing, unknown, of another type or out of its limits.
    """
    for name in LIMITS:
        if name not in content:
            raise InputError(f"{where}: {name} is missing")
    for name, limits in content.items():
        if name not in LIMITS:
            raise InputError(f"{where}: unknown key {name!r:.80}; known: {', '.join(LIMITS)}")
        numbers = isinstance(limits, list) and all(isinstance(each, float) for each in limits)
        if not numbers or len(limits) != 2:
            raise InputError(f"{where}.{name} must be two numbers, got {limits!r:.80}")
    try:
        return Conditions(**{name: (low, high) for name, (low, high) in content.items()})
    except InputError as error:
        raise InputError(f"{where}: {error}") from None


def sample_ages(link: Link, steps: int, size: int, seed: int) -> NDArray[np.int64]:
    """Return the age of the newest sample that has arrived at the beginning of each step.

    Before the lift everything has been at rest, so that samples of then have arrived, too.

    Parameters
    ----------
    link
        The way of the samples.
    steps, size
        Steps of the lift, and frames in each.
    seed
        Seed of losses and jitter.

    Returns
    -------
    (steps + 1,)
        Frames, at most :data:`OLDEST`.
    """
    drawn = link_delays(link, derive_seed(seed, "loss"), derive_seed(seed, "jitter"))
    sampled = np.arange(1 - 2 * HISTORY_FRAMES, steps * size + 1)
    delays = [math.inf if delay is None else delay for delay in islice(drawn, len(sampled))]
    decided = size * np.arange(steps + 1)
    arrived = sampled + np.array(delays) <= decided[:, np.newaxis]
    newest = np.where(arrived, sampled, decided[:, np.newaxis] - OLDEST).max(axis=1)
    return np.asarray(decided - newest)
