"""Movement smoothness of a speed profile: spectral arc length and dimensionless jerk.

For all three metrics a larger (less negative) value is smoother. None depends on the size of the
movement. All are meant for a single movement: two perfect movements with a rest in between score
worse than either alone, so cut a trial into movements first. Rest left at the ends of a movement
hardly changes its spectral arc length, but raises its dimensionless jerk with the duration cubed.

A profile that hardly moves has no smoothness and gets NaN, never a good score.

References
----------
S. Balasubramanian, A. Melendez-Calderon, A. Roby-Brami, E. Burdet (2015). On the analysis of
movement smoothness. Journal of NeuroEngineering and Rehabilitation 12:112.

N. Hogan, D. Sternad (2009). Sensitivity of smoothness measures to movement duration, amplitude,
and arrests. Journal of Motor Behavior 41(6):529-534.
"""

import math
from typing import Final

import numpy as np
from colift.base.errors import InputError
from colift.robots.arithmetic import dot
from numpy.typing import ArrayLike, NDArray

MIN_PEAK_SPEED: Final = 1e-3
"""Peak speed [m/s] below which a profile counts as not moving."""

MIN_SAMPLES: Final = 10
"""Shortest profile that has a smoothness: 0.1 s at 100 Hz, one control period."""

_JERK_ROUNDING = 1e-9
"""Dimensionless jerk that is rounding error: a movement from zero to zero speed has at least 48."""


def sparc(
    speed: ArrayLike,
    *,
    fs: float = 100.0,
    fc: float = 20.0,
    amp_th: float = 0.05,
    padlevel: int = 4,
) -> float:
    r"""Return the spectral arc length (SPARC) of a speed profile.

    With :math:`M(f) = |V(f)| / \max_f |V(f)|` the normalised magnitude of the Fourier transform of
    the speed, zero-padded to :math:`2^{\lceil \log_2 N \rceil + \text{padlevel}}` samples,

    .. math:: \mathrm{SPARC} = -\sum_k \sqrt{
        \left(\frac{f_{k+1} - f_k}{f_b - f_a}\right)^2 + \left(M_{k+1} - M_k\right)^2 },

    over the frequencies from :math:`f_a` to :math:`f_b`, the first and the last of those up to
    ``fc`` with :math:`M \ge` ``amp_th`` (Balasubramanian et al. 2015).

    Parameters
    ----------
    speed
        Speed [m/s], shape (N,).
    fs
        Sampling rate [Hz].
    fc
        Upper limit of the frequencies [Hz], at most fs / 2. The authors' code has 10 Hz, which
        would hide the second harmonic of a robot that moves in steps of 100 ms.
    amp_th
        Magnitude below which the tail of the spectrum is ignored, relative to the largest.
    padlevel
        Zero-padding, in powers of two.

    Returns
    -------
    float
        Arc length, dimensionless and negative; NaN for a profile that does not move or is shorter
        than ``MIN_SAMPLES``.

    Raises
    ------
    InputError
        If ``speed`` is not a finite vector, or ``fc`` is above the Nyquist frequency.
    """
    if not 0.0 < fc <= fs / 2:
        raise InputError(f"fc is {fc} Hz; it must lie in (0, {fs / 2}], half the sampling rate")
    v = _profile(speed)
    if not _moves(v):
        return math.nan
    nfft = 2 ** (math.ceil(math.log2(v.size)) + padlevel)
    spectrum = np.fft.rfft(v, nfft)
    power = spectrum.real**2 + spectrum.imag**2
    magnitude = np.sqrt(power[: math.floor(fc * nfft / fs) + 1] / power.max())
    above = np.flatnonzero(magnitude >= amp_th)
    if above.size < 2:
        return math.nan
    kept = magnitude[above[0] : above[-1] + 1]
    df = 1.0 / (kept.size - 1)
    return -float(np.sqrt(df**2 + np.diff(kept) ** 2).sum())


def dimensionless_jerk(speed: ArrayLike, *, fs: float = 100.0) -> float:
    r"""Return the dimensionless jerk of a speed profile.

    .. math:: \mathrm{DJ} = -\frac{T^3}{v_\mathrm{peak}^2} \sum_t \ddot v_t^2 \, \Delta t,
        \qquad T = N \Delta t,

    with the second difference of the speed as jerk (Hogan & Sternad 2009). The duration
    counts N samples, not N - 1 intervals, as in the code of Balasubramanian et al. (2015).

    Parameters
    ----------
    speed
        Speed [m/s], shape (N,).
    fs
        Sampling rate [Hz].

    Returns
    -------
    float
        Jerk, dimensionless, zero or negative; NaN for a profile that does not move or is shorter
        than ``MIN_SAMPLES``. It is zero only for a constant speed, cut out of a movement.

    Raises
    ------
    InputError
        If ``speed`` is not a finite vector.
    """
    v = _profile(speed)
    if not _moves(v):
        return math.nan
    dt = 1.0 / fs
    jerk = np.diff(v, 2) / dt**2
    duration, peak = v.size * dt, float(np.abs(v).max())
    return -(duration**3) / peak**2 * float(dot(jerk, jerk)) * dt


def ldlj(speed: ArrayLike, *, fs: float = 100.0) -> float:
    r"""Return the log dimensionless jerk (LDLJ) of a speed profile.

    .. math:: \mathrm{LDLJ} = -\ln |\mathrm{DJ}|

    with :func:`dimensionless_jerk` (Balasubramanian et al. 2015). The value of a minimum-jerk
    movement is -5.32.

    Parameters
    ----------
    speed
        Speed [m/s], shape (N,).
    fs
        Sampling rate [Hz].

    Returns
    -------
    float
        Log dimensionless jerk; NaN if the jerk is NaN, or zero up to rounding, whose logarithm
        would be the best score of all.

    Raises
    ------
    InputError
        If ``speed`` is not a finite vector.
    """
    jerk = abs(dimensionless_jerk(speed, fs=fs))
    return -math.log(jerk) if jerk > _JERK_ROUNDING else math.nan


def _profile(speed: ArrayLike) -> NDArray[np.float64]:
    v = np.asarray(speed, dtype=np.float64)
    if v.ndim != 1:
        raise InputError(f"speed has shape {v.shape}; it must be a vector of samples, shape (N,)")
    if not np.isfinite(v).all():
        raise InputError(f"speed at sample {np.isfinite(v).argmin()} is not a finite number")
    return v


def _moves(v: NDArray[np.float64]) -> bool:
    return v.size >= MIN_SAMPLES and bool(np.abs(v).max() >= MIN_PEAK_SPEED)
