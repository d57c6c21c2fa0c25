"""Preview control: the next command for a forecast path."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from colift.agents.agent import FRAME
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class PreviewGains:
    """The linear law of :func:`preview_gains`."""

    path: Array
    """(steps * frames,) weight of the path's height in each coming frame."""
    command: float
    """Weight of the command now."""
    last_command: float
    """Weight of the command one period ago."""

    def __call__(self, path: Array, command: float, last_command: float) -> float:
        """Return the command for the end of the period [m]; all heights in m."""
        follow = float(self.path @ path)
        return follow + self.command * command + self.last_command * last_command


@lru_cache(maxsize=32)
def preview_gains(frames: int, steps: int, smoothness: float) -> PreviewGains:
    r"""Return the optimal next command for a forecast path, as a linear law.

    A command ramps over its period: the commands u_1, u_2, ... at the ends of the coming periods
    are the knots of a piecewise linear u(t), which begins at the present command u_0. They minimise

    .. math:: \int (h(t) - u(t))^2 dt + T \rho \sum_i (u_{i+1} - 2 u_i + u_{i-1})^2

    over the coming ``steps`` periods of length T. It is a least-squares problem; the first command
    is carried out, and the rest is optimised again with the next sample (receding horizon). The
    path may be the mean of an uncertain forecast: as the cost is quadratic and the commands do not
    affect the path, no other moment matters (certainty equivalence).

    Parameters
    ----------
    frames
        Frames of 10 ms per period.
    steps
        Periods of the forecast.
    smoothness
        rho, the cost of a bend of u(t), relative to a height difference of its size that lasts for
        a period.
    """
    ramp = np.arange(1, frames + 1) / frames
    knots = np.zeros((steps * frames, steps + 1))
    for step in range(steps):
        rows = slice(step * frames, (step + 1) * frames)
        knots[rows, step] = 1.0 - ramp
        knots[rows, step + 1] = ramp
    # The columns of both matrices are u_(-1), u_0, u_1, ...
    line = FRAME * np.hstack((np.zeros((len(knots), 1)), knots))
    bends = np.zeros((steps, steps + 2))
    for step in range(steps):
        bends[step, step : step + 3] = 1.0, -2.0, 1.0
    hessian = line[:, 2:].T @ knots[:, 1:]
    hessian += frames * FRAME * smoothness * bends[:, 2:].T @ bends[:, 2:]
    known = line[:, 2:].T @ np.hstack((np.zeros((len(knots), 1)), knots[:, :1]))
    known += frames * FRAME * smoothness * bends[:, 2:].T @ bends[:, :2]
    path = np.linalg.solve(hessian, line[:, 2:].T)[0]
    past = -np.linalg.solve(hessian, known)[0]
    path.flags.writeable = False
    return PreviewGains(path=path, command=float(past[1]), last_command=float(past[0]))
