"""Metrics of one episode: pure functions from recorded traces to one number each.

Every trace is sampled at 100 Hz. Heights are displacements of the table's two ends [m] from its
rest height: Z1 the human's end, Z2 the robot's. NaN means that the episode has no value.
"""

import math
from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.base.errors import InputError
from colift.robots.arithmetic import dot
from numpy.typing import ArrayLike, NDArray

FAILED_FRAME_MM: Final = 250.0
"""Height difference that counts for each frame after a failure [mm]: holding still in a 0.20 m lift
costs less."""

MIN_MOTION: Final = 0.005
"""Peak-to-peak height [m] below which an end counts as held still."""

MIN_SHARE: Final = 0.25
"""Share of the human's movement in a stroke below which the robot has not moved along."""

STROKE_TAIL: Final = 0.3
"""Time [s] after a stroke of the human in which the robot may still be completing it."""

REST_TAIL: Final = 0.5
"""Time [s] after a stroke of the human after which the robot is at rest, too: twice the delay of
one that copies."""

MIN_LAG: Final = -0.3
"""Least delay of the robot in the search [s]; negative when the robot leads."""

MAX_LAG: Final = 1.0
"""Largest delay of the robot in the search [s]."""

Stroke = tuple[int, int]
"""One movement of the human: its first frame and the frame after its last."""


def rmse_mm(human_end: ArrayLike, robot_end: ArrayLike, *, horizon: int | None = None) -> float:
    r"""Return the root mean square height difference of the table's ends over the whole trial.

    .. math:: \mathrm{RMSE} = \sqrt{\tfrac{1}{H} \sum_t (Z_{1t} - Z_{2t})^2}

    The measure of the paper's Table I, rest before and after the lift included.

    Parameters
    ----------
    human_end, robot_end
        Heights Z1 and Z2 [m] at 100 Hz, shape (T,).
    horizon
        Frames H the episode should have had; T by default. Each of the H - T frames that a failure
        cut off counts with ``FAILED_FRAME_MM``, so that giving up early never pays.

    Returns
    -------
    float
        Error [mm].

    Raises
    ------
    InputError
        If the traces are not finite vectors of one length, are longer than ``horizon``, or if
        there is no frame and no horizon.
    """
    error, missing = _error_mm(human_end, robot_end, horizon)
    squares = float(dot(error, error)) + missing * FAILED_FRAME_MM**2
    return math.sqrt(squares / (error.size + missing))


def rmse_about_mean_mm(
    human_end: ArrayLike, robot_end: ArrayLike, *, horizon: int | None = None
) -> float:
    r"""Return the root mean square of the height difference about its mean over the trial.

    .. math:: \sqrt{\tfrac{1}{H} \sum_t (d_t - \bar d)^2}, \quad d_t = Z_{1t} - Z_{2t}

    What remains of :func:`rmse_mm` without a constant tilt: the squared RMSE is the square of this
    plus that of the mean difference. Real pairs keep such a tilt for whole lifts.

    Parameters and errors are those of :func:`rmse_mm`; a missing frame counts with
    ``FAILED_FRAME_MM`` and is not part of the mean.

    Returns
    -------
    float
        Error [mm].
    """
    error, missing = _error_mm(human_end, robot_end, horizon)
    about = error - dot(error, np.ones_like(error)) / max(1, error.size)
    squares = float(dot(about, about)) + missing * FAILED_FRAME_MM**2
    return math.sqrt(squares / (about.size + missing))


def abs_error_mm(
    human_end: ArrayLike, robot_end: ArrayLike, *, horizon: int | None = None
) -> float:
    r"""Return the absolute error of the trial, eq. 10 of the paper.

    .. math:: \mathrm{AbsoluteError} = \sum_t |Z_{1t} - Z_{2t}|

    A sum over frames of 10 ms, neither a mean nor an integral over time: it grows with the length
    of the trial and with the frame rate.

    Parameters
    ----------
    human_end, robot_end, horizon
        As for :func:`rmse_mm`, with the same rule for frames after a failure.

    Returns
    -------
    float
        Sum [mm] over the frames at 100 Hz.

    Raises
    ------
    InputError
        As for :func:`rmse_mm`.
    """
    error, missing = _error_mm(human_end, robot_end, horizon)
    return float(np.abs(error).sum()) + missing * FAILED_FRAME_MM


def max_tilt_deg(human_end: ArrayLike, robot_end: ArrayLike, length: float) -> float:
    r"""Return the largest incline of the table, :math:`\max_t \arcsin(|Z_{1t} - Z_{2t}| / L)`.

    Parameters
    ----------
    human_end, robot_end
        Heights Z1 and Z2 [m], shape (T,).
    length
        Length L of the table between the points whose heights are given [m].

    Returns
    -------
    float
        Angle [deg], 0 to 90.

    Raises
    ------
    InputError
        If the traces are not finite vectors of one length, are empty, or lie further apart in
        height than the table is long.
    """
    error, _ = _error_mm(human_end, robot_end, None)
    sine = float(np.abs(error).max()) / 1000 / length if length > 0 else math.inf
    if sine > 1.0:
        raise InputError(
            f"length is {length} m; it must be positive and no less than the largest height "
            f"difference of the ends, {np.abs(error).max() / 1000:.3f} m"
        )
    return math.degrees(math.asin(sine))


def stroke_smoothness(
    height: ArrayLike,
    human_end: ArrayLike,
    strokes: Sequence[Stroke],
    *,
    metric: Callable[[NDArray[np.float64]], float],
) -> float:
    """Return the mean smoothness of one table end over the human's strokes.

    Speed is the magnitude of the central difference of height. As the robot lags behind the human,
    the window of each stroke is extended by ``STROKE_TAIL`` (0.3 s), but not beyond the start of
    the next stroke or the end of the trace. The windows depend on the human alone, so that all
    robots are scored over the same ones.

    Parameters
    ----------
    height
        Height of the end [m] at 100 Hz, shape (T,), up to the failure if there was one.
    human_end
        Height of the human's end [m], shape (T,).
    strokes
        Frames (start, stop) of the human's movements, ``stop`` exclusive, in order and without
        overlap, each well above ``MIN_MOTION``.
    metric
        Smoothness of a speed profile [m/s] at 100 Hz:
        :func:`~colift.benchmark.episode.smoothness.sparc`,
        :func:`~colift.benchmark.episode.smoothness.ldlj`.

    Returns
    -------
    float
        Mean over the strokes; NaN for the whole episode if there is no stroke, if the trace ends
        before a stroke does (the lift failed), or if in any of them this end moves less than
        ``MIN_MOTION``, or less than ``MIN_SHARE`` of the human's movement. Holding still or
        creeping, even in a single stroke, never counts as smooth.

    Raises
    ------
    InputError
        If the heights are not finite vectors of one length, or the strokes are empty, unordered
        or overlapping.
    """
    z, human = _pair("height", height, "human_end", human_end)
    for (start, stop), previous_stop in zip(strokes, [0, *(s[1] for s in strokes)], strict=False):
        if not previous_stop <= start < stop:
            raise InputError(
                f"stroke ({start}, {stop}) must start at frame {previous_stop} or later, "
                "where the one before it stops, and before its own stop"
            )
    if not strokes or strokes[-1][1] > z.size:
        return math.nan
    speed = np.abs(np.gradient(z, FRAME))
    tail = round(STROKE_TAIL / FRAME)
    next_starts = [*(start for start, _ in strokes[1:]), z.size]
    scores: list[float] = []
    for (start, stop), next_start in zip(strokes, next_starts, strict=True):
        window = slice(start, min(stop + tail, next_start))
        if np.ptp(z[window]) < max(MIN_MOTION, MIN_SHARE * float(np.ptp(human[window]))):
            return math.nan
        scores.append(metric(speed[window]))
    return math.fsum(scores) / len(scores)


def rest_speed_mm_s(height: ArrayLike, strokes: Sequence[Stroke]) -> float:
    """Return the root mean square speed of one table end while the human rests.

    It is the trembling of who holds this end. The human rests outside the strokes and
    ``REST_TAIL`` (0.5 s) after each.

    Parameters
    ----------
    height
        Height of the end [m] at 100 Hz, shape (T,), up to the failure if there was one.
    strokes
        Frames (start, stop) of the human's movements, ``stop`` exclusive.

    Returns
    -------
    float
        Speed [mm/s]; NaN if there is no such frame.

    Raises
    ------
    InputError
        If the heights are not a finite vector with at least two frames.
    """
    z = _trace("height", height)
    if z.size < 2:
        raise InputError(f"height has {z.size} frame; a speed needs at least two")
    rests = np.ones(z.size, dtype=bool)
    for start, stop in strokes:
        rests[start : stop + round(REST_TAIL / FRAME)] = False
    speed = np.gradient(z, FRAME)[rests]
    return 1000.0 * math.sqrt(float(dot(speed, speed)) / speed.size) if speed.size else math.nan


def human_force_n(force: ArrayLike) -> float:
    """Return the root mean square vertical force at the human's hands.

    Parameters
    ----------
    force
        Force [N], shape (T,).

    Returns
    -------
    float
        Force [N].

    Raises
    ------
    InputError
        If ``force`` is not a finite vector with at least one frame.
    """
    f = _trace("force", force)
    return math.sqrt(float(dot(f, f)) / f.size)


def human_work_j(force: ArrayLike, velocity: ArrayLike) -> float:
    r"""Return the mechanical work that passes through the human's hands, in either direction.

    .. math:: W = \int |F v| \, dt

    by the trapezoidal rule. The absolute value is taken since lowering a load also costs muscles
    energy.

    Parameters
    ----------
    force
        Vertical force at the hands [N] at 100 Hz, shape (T,).
    velocity
        Vertical velocity of the hands [m/s], shape (T,).

    Returns
    -------
    float
        Work [J].

    Raises
    ------
    InputError
        If the traces are not finite vectors of one length with at least one frame.
    """
    f, v = _pair("force", force, "velocity", velocity)
    return float(np.trapezoid(np.abs(f * v), dx=FRAME))


def robot_lag_ms(human_end: ArrayLike, robot_end: ArrayLike) -> float:
    r"""Return the delay of the robot's end behind the human's.

    .. math:: \arg\max_\tau \sum_t \dot Z_1(t) \, \dot Z_2(t + \tau)

    over delays from ``MIN_LAG`` to ``MAX_LAG``, refined below a frame by the parabola through the
    maximum and its two neighbours. Velocity outside the trace counts as zero.

    Parameters
    ----------
    human_end, robot_end
        Heights Z1 and Z2 [m] at 100 Hz, shape (T,).

    Returns
    -------
    float
        Delay [ms], negative if the robot leads. A maximum at the edge of the range is returned as
        it is: the true delay is at least that long. NaN if either end moves less than
        ``MIN_MOTION`` or the velocities correlate at no delay.

    Raises
    ------
    InputError
        If the traces are not finite vectors of one length with at least one frame.
    """
    human, robot = _pair("human_end", human_end, "robot_end", robot_end)
    if min(np.ptp(human), np.ptp(robot)) < MIN_MOTION:
        return math.nan
    first, last = round(MIN_LAG / FRAME), round(MAX_LAG / FRAME)
    velocity = np.pad(np.gradient(robot), (-first, last))
    delayed = np.lib.stride_tricks.sliding_window_view(velocity, human.size)
    correlation = dot(delayed, np.gradient(human))
    best = int(correlation.argmax())
    if correlation[best] <= 0.0:
        return math.nan
    lag = float(first + best)
    if 0 < best < last - first:
        before, peak, after = (float(c) for c in correlation[best - 1 : best + 2])
        lag += 0.5 * (before - after) / (before - 2.0 * peak + after)
    return lag * FRAME * 1000


def _error_mm(
    human_end: ArrayLike, robot_end: ArrayLike, horizon: int | None
) -> tuple[NDArray[np.float64], int]:
    """Return Z1 - Z2 [mm] for each frame, and the number of frames missing up to the horizon."""
    if horizon and np.size(human_end) == np.size(robot_end) == 0:
        return np.empty(0), horizon
    human, robot = _pair("human_end", human_end, "robot_end", robot_end)
    missing = 0 if horizon is None else horizon - human.size
    if missing < 0:
        raise InputError(f"horizon is {horizon} frames; the traces already have {human.size}")
    return 1000.0 * (human - robot), missing


def _pair(
    name_a: str, a: ArrayLike, name_b: str, b: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    x, y = _trace(name_a, a), _trace(name_b, b)
    if x.size != y.size:
        raise InputError(
            f"{name_a} has {x.size} frames, {name_b} {y.size}; both must have equally many"
        )
    return x, y


def _trace(name: str, values: ArrayLike) -> NDArray[np.float64]:
    trace = np.asarray(values, dtype=np.float64)
    if trace.ndim != 1 or trace.size == 0:
        raise InputError(f"{name} has shape {trace.shape}; it must be a trace of frames, (T,)")
    if not np.isfinite(trace).all():
        raise InputError(f"{name} at frame {np.isfinite(trace).argmin()} is not a finite number")
    return trace
