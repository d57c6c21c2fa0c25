"""What a person learns about a partner, from lift to lift."""

from typing import Any, Final, Generic, NamedTuple

from colift.agents.agent import FRAME
from colift.agents.rules import ArrayFunctions, N

FAST: Final = (0.59, 0.21)
SLOW: Final = (0.992, 0.02)
"""Retention and rate of learning, for each trial, of the fast and of the slow process of motor
adaptation: Smith, Ghazizadeh and Shadmehr, "Interacting adaptive processes with different
timescales underlie short-term motor learning", PLoS Biology 4 (2006), table 1."""

TRIALS: Final = 2
"""Trials in a lift: its way up, and its way down (assumed)."""

STRANGER_TRUST: Final = 0.4
"""Trust in a stranger (assumed)."""

TRUST_RATE: Final = 0.3
"""Share by which the trust approaches the evidence of a lift (assumed)."""

UNPREDICTABLE: Final = 0.1
"""Unexplained lag at which a partner deserves a trust of 1 / e [s] (assumed)."""

LONGEST_LAG: Final = 0.5
"""Limit of the lag that a person believes in, to either side [s]."""

_SPEED: Final = 1e-3
"""Speed that counts in addition, so that a lift without movement tells nothing [m/s]."""


class Acquaintance(NamedTuple, Generic[N]):
    """What a person knows about the partner."""

    fast: N
    """Part of the expected lag that is learned and forgotten fast [s]."""
    slow: N
    """Part that is learned and forgotten slowly [s]."""
    trust: N
    """Confidence that the partner does what is expected, from 0 to 1."""

    @property
    def lag(self) -> N:
        """The expected lag of the partner's end behind the own one [s]; below 0 it leads."""
        return self.fast + self.slow


STRANGER: Final[Acquaintance[float]] = Acquaintance(0.0, 0.0, STRANGER_TRUST)
"""What is known about somebody new."""


class Impression(NamedTuple, Generic[N]):
    """What one lift shows of the partner."""

    lag: N
    """Lag of the other end, by least squares [s]."""
    unexplained: N
    """Mean square height difference that this lag does not explain, over that of the speed [s2]."""


def impression(f: ArrayFunctions[N], near: Any, far: Any) -> Impression[N]:
    r"""Return the impression of a lift.

    With the height difference :math:`d_t` of the ends and the speed :math:`v_t` of the own one, it
    is

    .. math::

        L = \frac{\sum d_t v_t}{\sum v_t^2}, \qquad
        u^2 = \frac{\sum (d_t - L v_t)^2}{\sum v_t^2}

    Parameters
    ----------
    f
        The functions of numbers.
    near, far
        Height of the own end and of the other one in each frame [m]: lists, or arrays (frames, n).
    """
    speed: Any = f.each(lambda now, before: (now - before) / FRAME, near[1:], near[:-1])
    apart: Any = f.each(lambda one, other: one - other, near[1:], far[1:])
    moved = f.total(f.each(lambda v: v * v + _SPEED**2, speed))
    lag = f.total(f.each(lambda d, v: d * v, apart, speed)) / moved
    lag = f.clip(lag, -LONGEST_LAG, LONGEST_LAG)
    rest = f.total(f.each(lambda d: d * d, apart)) / moved
    return Impression(lag, rest - lag * lag)


def after_lift(
    f: ArrayFunctions[N], known: Acquaintance[N], seen: Impression[N]
) -> Acquaintance[N]:
    r"""Return what a person knows after a lift.

    In each of :data:`TRIALS`, the processes i of :data:`FAST` and :data:`SLOW` learn from the error
    of the expected lag (equations 1 to 3 of Smith et al.):

    .. math:: x_i \leftarrow A_i x_i + B_i (L - x_1 - x_2)

    The trust approaches :math:`\exp(-u^2 / u_0^2)`, with :math:`u_0` = :data:`UNPREDICTABLE`.
    """
    fast, slow = known.fast, known.slow
    for _ in range(TRIALS):
        error = seen.lag - fast - slow
        fast, slow = FAST[0] * fast + FAST[1] * error, SLOW[0] * slow + SLOW[1] * error
    evidence = f.exp(-seen.unexplained / UNPREDICTABLE**2)
    return Acquaintance(fast, slow, known.trust + TRUST_RATE * (evidence - known.trust))
