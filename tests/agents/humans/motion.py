"""A lift by a formula, and files of recordings."""

import numpy as np
from colift.agents.estimators.minimum_jerk import profile


def lift(rate=100.0, duration=6.0, base=0.9, top=0.22):
    """Return times [s] and heights [m] of a lift and its return."""
    times = np.arange(int(duration * rate)) / rate
    up, down = profile((times - 1.0) / 1.8), profile((times - 4.0) / 1.6)
    sway = 0.02 * np.sin(2 * np.pi * 0.7 * times) * up
    return times, base + top * up + sway - 0.9 * top * down


def rows(times, heights, trial="a", form=".6f"):
    """Return the rows of a trial."""
    return "".join(
        f"{trial},{time:{form}},{height:{form}}\n"
        for time, height in zip(times, heights, strict=True)
    )


def table(*trials, header="trial,t_s,z_m\n"):
    """Return a file of trials, each the rows of one."""
    return header + "".join(trials)
