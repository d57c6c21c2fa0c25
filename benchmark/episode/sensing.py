"""Senses of a robot: exact numbers by rules, and errors drawn before the lift."""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from colift.agents.rules import ArrayFunctions, N, View
from colift.agents.senses import FORCE_NOISE, MOCAP_NOISE, SIGHT, TORQUE_NOISE, TOUCH, Sense
from colift.benchmark.world.interface import HISTORY_FRAMES
from colift.benchmark.world.table import WEIGHT_SHARE
from numpy.typing import NDArray

SENSED_FRAMES: Final = 5
"""Frames over which the force and torque sensors average."""


def sight(f: ArrayFunctions[N], view: View[N]) -> tuple[N, ...]:
    """Return the numbers of :data:`.SIGHT`."""
    return (
        view.seen("human_end", view.latency),
        view.seen("robot_end", view.latency),
        view.hand,
        view.command,
        0.0 * view.command + f.seconds(view.frame),
    )


def touch(f: ArrayFunctions[N], view: View[N]) -> tuple[N, N]:
    """Return the numbers of :data:`.TOUCH`."""
    force, torque = (
        f.total(f.row([view.seen(name, age) for age in range(SENSED_FRAMES)], view.hand))
        / SENSED_FRAMES
        for name in ("robot_force", "robot_torque")
    )
    return force - WEIGHT_SHARE, torque


def drawn_errors(
    senses: Sequence[Sense],
    with_touch: bool,
    seed: Callable[[str], int],
    steps: int,
    size: int,
    ages: int | NDArray[np.int64],
    precision: float = 1.0,
) -> NDArray[np.float64]:
    """Return the errors of a robot's senses at the beginning of each step, and at the end.

    Parameters
    ----------
    senses
        The task's own ones.
    with_touch
        Whether the robot senses force and torque.
    seed
        Returns the lift's seed of a role.
    steps, size
        Steps of the lift, and frames in each.
    ages
        Age of the motion capture's sample in frames: always the same, or (steps + 1,). The error is
        that of the sample: seen again, it has the same one.
    precision
        Factor of the motion capture's error.

    Returns
    -------
    (steps + 1, k)
    """
    frames = HISTORY_FRAMES + steps * size
    sampled = size * np.arange(steps + 1) + HISTORY_FRAMES - 1 - ages

    def drawn(role: str) -> np.random.Generator:
        return np.random.default_rng(seed(f"{role}sensor"))

    errors = np.zeros((len(SIGHT) + (len(TOUCH) if with_touch else 0) + len(senses), steps + 1))
    seen = drawn("").normal(0.0, precision * MOCAP_NOISE, (2, frames))
    errors[:2] = seen[:, sampled]
    own = len(SIGHT)
    if with_touch:
        own += len(TOUCH)
        noise = np.array([[FORCE_NOISE], [TORQUE_NOISE]])
        errors[len(SIGHT) : own] = noise * drawn("force ").normal(0.0, 1.0, (2, steps + 1))
    for row, sense in zip(errors[own:], senses, strict=True):
        if sense.noise:
            series = drawn(f"{sense.role or sense.name} ").normal(0.0, sense.noise, frames)
            row[:] = series[sampled]
    return errors.T
