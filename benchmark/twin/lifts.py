"""Drawn lifts as arrays: people, plans, noise and conditions."""

from typing import Any, NamedTuple, TypeVar

import jax
from colift.agents.rules import Drawn
from colift.benchmark.twin.arm import ArmVariation
from colift.benchmark.twin.body import CHUNK, Body

Many = TypeVar("Many")


class Hand(NamedTuple):
    """How unsteady the hands of n people are; see :class:`.Subject`."""

    motor_noise: Any
    """(n,)"""
    tremor_amplitude: Any
    """(n,) [m]"""
    tremor_frequency: Any
    """(n,) [Hz]"""


class Lifts(NamedTuple):
    """n lifts of at most s steps of f frames, in single precision."""

    drawn: Drawn[Any]
    """Plans, and what else is drawn of tasks and people."""
    gain: jax.Array
    """(s, f, n) signal-dependent noise of the person's hand, relative to its velocity."""
    tremor: jax.Array
    """(s, f, n) tremor of the hand [m]."""
    hand: Hand
    """The hands that have this noise."""
    errors: jax.Array
    """(s, k, n) errors of the robot's senses."""
    ages: jax.Array
    """(s, n) age of the motion capture's sample in frames."""
    stop: jax.Array
    """(n,) frame after the plan's last movement."""
    steps: jax.Array
    """(n,) length in steps."""
    body: Body
    """The people, and their tables."""
    arms: ArmVariation | None
    """Variation of the robots' arms; None is the benchmark's arms."""

    @property
    def size(self) -> int:
        """Number of lifts."""
        return int(self.steps.shape[0])

    @property
    def frames(self) -> int:
        """Frames of a step."""
        return int(self.gain.shape[1])

    @property
    def longest(self) -> int:
        """Steps of the longest lift."""
        return int(self.gain.shape[0])


class Share(NamedTuple):
    """A step's share of the noise of lifts; see :class:`Lifts`."""

    gain: jax.Array
    """(f, n)"""
    tremor: jax.Array
    """(f, n)"""
    errors: jax.Array
    """(k, n)"""
    ages: jax.Array
    """(n,)"""


def shares(lifts: Lifts) -> Share:
    """Return the shares of all steps, with a first axis of steps."""
    return Share(lifts.gain, lifts.tremor, lifts.errors, lifts.ages)


def some(lifts: Many, chosen: Any) -> Many:
    """Return the chosen lifts: an index array or a slice of the last axis."""
    taken: Many = jax.tree.map(lambda array: array[..., chosen], lifts)
    return taken


def chunk(size: int) -> int:
    """Return the number of frames in each part of a step of ``size`` frames."""
    return next(many for many in range(CHUNK, 0, -1) if size % many == 0)
