"""A Bayesian filter of the pose that a leading person intends."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.ranges import Positive, Probability, Shares, check_ranges
from colift.agents.tasks.touch.touched import FAR_STIFFNESS, TABLE_LENGTH, WRIST_STIFFNESS
from numpy.typing import NDArray

SHARES: Final = (1.0, 0.0, -1.0)
"""Movement of the far end as a share of the near end's: together, pivot, counter."""

LEAST_WEIGHT: Final = 1e-6
"""Least weight of a hypothesis: people differ from the model."""


@dataclass(frozen=True, kw_only=True)
class PoseFilterParameters:
    """Parameters of :class:`PoseFilter`."""

    wrists: Shares = (-0.4, -0.1, 0.2, 0.5, 0.8, 1.2)
    """Shares of the intended pitch that the wrists may show, equally likely."""
    switch: Probability = 0.03
    """Probability that the intent changes within a step."""
    pitch_noise: Positive = 0.012
    """Standard deviation of a sensed wrist pitch [rad]: force sensor, lead and inertia."""
    path_noise: Positive = 0.25
    """Standard deviation of the far end's intended movement, relative to the near end's."""
    still: Positive = 0.001
    """Standard deviation of the far end's intended movement in a step at rest [m]."""
    patience: Positive = 0.05
    """Distance of the far end from its intended height [m] beyond which a person slows down."""
    moves: Positive = 0.003
    """Movement of the near end in a step [m] that is equally likely for a person who waits and one
    who goes on."""
    haste: Probability = 0.1
    """Probability that a person moves on although the far end is more than twice that distance
    off."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


_exponential: Final = np.vectorize(math.exp, otypes=[np.float64])
"""The C library's exponential: the bits of NumPy's depend on the processor's vector extensions."""


class PoseFilter:
    """Estimates the height that a person intends for the far end, and its direction of movement.

    For each share g of the intended pitch that the wrists may show, and each ratio of the far end's
    movement to the near end's, a Kalman filter of the intended height f of the far end:

        f' = f + share (z1' - z1),        the intended movement,
        w  = g (f - z1) / L,              the pitch that the wrists turn towards,

    with the near end's height z1. The weights follow Bayes' rule; the ratio changes with a constant
    probability, as in an interacting multiple model (H. A. P. Blom, Y. Bar-Shalom, IEEE
    Transactions on Automatic Control 33, 1988), and g never does.

    A person waits for a far end that is not where it should be. The movement of the near end
    therefore gives the likelihood of each f, given where the far end has been.

    The wrists' pitch follows from statics of the table, with the pitch p and the measured force F
    beyond the robot's half of its weight:

        w = p + (k_far p - F L) / k_wrist.
    """

    def __init__(self, parameters: PoseFilterParameters | None = None) -> None:
        self._p = parameters or PoseFilterParameters()
        shape = (len(SHARES), len(self._p.wrists))
        self._share = np.repeat(np.array(SHARES)[:, np.newaxis], shape[1], axis=1)
        self._wrist = np.repeat(np.array(self._p.wrists)[np.newaxis], shape[0], axis=0)
        stay, other = 1.0 - self._p.switch, self._p.switch / (len(SHARES) - 1)
        self._change = np.where(np.eye(len(SHARES)) > 0, stay, other)
        self.reset()

    def reset(self) -> None:
        """Begin a lift, with the table level at height 0."""
        self._weight = np.full(self._share.shape, 1.0 / self._share.size)
        self._mean = np.zeros(self._share.shape)
        self._variance = np.full(self._share.shape, 1e-8)
        self._near = self._far = 0.0

    def update(self, near: float, pitch: float, force: float) -> None:
        """Update by the near end's height [m], the pitch [rad] and the hands' force [N] of a step.

        Parameters
        ----------
        near
            Height of the person's end.
        pitch
            Pitch of the table, positive if the far end is higher.
        force
            Force of the far hands on the table, beyond their half of its weight, upwards positive.
        """
        wrist = pitch + (FAR_STIFFNESS * pitch - force * TABLE_LENGTH) / WRIST_STIFFNESS
        rise = near - self._near
        self._near = near
        self._mix()
        self._mean = self._mean + self._share * rise
        self._variance = self._variance + (self._p.path_noise * rise) ** 2 + self._p.still**2

        slope = self._wrist / TABLE_LENGTH
        surprise = wrist - slope * (self._mean - near)
        spread = slope**2 * self._variance + self._p.pitch_noise**2
        gain = slope * self._variance / spread
        self._mean = self._mean + gain * surprise
        self._variance = (1.0 - gain * slope) * self._variance
        unlikely = 0.5 * surprise**2 / spread
        likelihood = _exponential(unlikely.min() - unlikely) / np.sqrt(spread)
        weight = self._weight * likelihood * self._waiting(abs(rise))
        self._far = near + TABLE_LENGTH * math.sin(pitch)
        weight = np.maximum(weight / weight.sum(), LEAST_WEIGHT)
        self._weight = weight / weight.sum()

    def _waiting(self, moved: float) -> NDArray[np.float64]:
        """Return the likelihood of a movement of the near end [m].

        It changes smoothly from that of no movement to that of a clear one: with a threshold, small
        differences of the movement would lead to different decisions.
        """
        away = np.abs(self._far - self._mean)
        goes = np.minimum(np.maximum(2.0 - away / self._p.patience, self._p.haste), 1.0)
        clear = moved / (moved + self._p.moves)
        return clear * goes + (1.0 - clear) * (1.0 - goes / 2)

    def _mix(self) -> None:
        """Let the ratio change, separately for each share of the wrists."""
        joint = self._change[:, :, np.newaxis] * self._weight[:, np.newaxis, :]
        weight = joint.sum(axis=0)
        part = joint / weight
        mean = (part * self._mean[:, np.newaxis, :]).sum(axis=0)
        apart = self._mean[:, np.newaxis, :] - mean[np.newaxis]
        spread = self._variance[:, np.newaxis, :] + apart**2
        self._variance = (part * spread).sum(axis=0)
        self._weight, self._mean = weight, mean

    @property
    def height(self) -> float:
        """The expected intended height of the far end [m]."""
        return float((self._weight * self._mean).sum())

    @property
    def share(self) -> float:
        """The expected ratio of the far end's movement to the near end's."""
        return float((self._weight * self._share).sum())

    @property
    def intents(self) -> NDArray[np.float64]:
        """The probability of each of :data:`SHARES`."""
        return np.asarray(self._weight.sum(axis=1))
