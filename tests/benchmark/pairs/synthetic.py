"""Pairs whose lag, gain and height difference are known."""

import numpy as np
from colift.agents.estimators.minimum_jerk import profile

START = 0.9
"""Height of the near end at the start [m]."""


def height(time, top=0.22, first=1.0):
    """Return the height of the near end [m] at any time [s]."""
    up, down = profile((time - first) / 1.8), profile((time - first - 3.0) / 1.6)
    sway = 0.02 * np.sin(2 * np.pi * 0.7 * time) * up
    return START + top * up + sway - 0.9 * top * down


def pair(rate, *, lag=0.0, gain=1.0, difference=0.0, noise=0.0, seed=0, top=0.22, first=1.0):
    """Return times, near and far heights of a lift.

    The far end follows the near one ``lag`` [s] later with a gain, and is lower by ``difference``
    [m] at the start.
    """
    rng = np.random.default_rng(seed)
    times = np.arange(0.0, 7.0, 1.0 / rate)
    near = height(times, top, first)
    far = START - difference + gain * (height(times - lag, top, first) - START)
    return times, *(each + noise * rng.standard_normal(len(times)) for each in (near, far))


def write(path, lifts, columns=("z_far_m",)):
    """Write lifts: trial, person, and the times, heights and further columns of each."""
    rows = [
        ",".join((trial, person, *(f"{value:.7f}" for value in row)))
        for trial, person, series in lifts
        for row in zip(*series, strict=True)
    ]
    header = ",".join(("trial", "person", "t_s", "z_m", *columns))
    path.write_text("\n".join([header, *rows]) + "\n")
    return path
