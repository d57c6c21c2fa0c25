"""The height of the other end from sight and touch: a Kalman filter with two ages of samples."""

from dataclasses import dataclass

from colift.agents.agent import Observation
from colift.agents.ranges import NotNegative, Positive, check_ranges
from colift.agents.tasks.touch.observation import HapticObservation
from colift.agents.tasks.touch.touched import FAR_STIFFNESS, TABLE_LENGTH


@dataclass(frozen=True, kw_only=True)
class TouchedEndParameters:
    """Parameters of :class:`TouchedEnd`."""

    latency: NotNegative = 0.1
    """Age of the seen heights [s]."""
    touch_age: NotNegative = 0.01
    """Age of the felt torque [s]: half of the sensor's average, less the lead of its damping."""
    seen_noise: Positive = 0.0003
    """Standard deviation of the seen height [m]."""
    felt_noise: Positive = 0.003
    """Standard deviation of the height felt by the torque [m]: 2 mNm over 0.8 m, and the effect of
    the table's inertia."""
    jerk: Positive = 0.5
    """Root of the spectral density of the human's acceleration [m/s^(3/2)]."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


class TouchedEnd:
    r"""Height z and velocity v of the human's end now.

    The motion is a random walk of the velocity. The samples are the seen height, ``latency`` old,
    and the height inferred from the torque M at the hands, z = hand + L M / k: noisier, but fresh.
    """

    def __init__(self, parameters: TouchedEndParameters | None = None) -> None:
        self._parameters = parameters or TouchedEndParameters()
        self.height = self.velocity = 0.0
        self._variance = (1e-6, 0.0, 1e-6)
        self._time: float | None = None

    def update(self, observation: Observation) -> None:
        """Update by an observation, laid out as :class:`.HapticObservation`."""
        p = self._parameters
        time = float(observation[HapticObservation.TIME])
        period = 0.1 if self._time is None else max(time - self._time, 1e-3)
        self._time = time
        a, b, c = self._variance
        q = p.jerk * p.jerk * period
        self.height += self.velocity * period
        self._variance = (
            a + 2 * period * b + period * period * (c + q / 3),
            b + period * (c + q / 2),
            c + q,
        )
        self._correct(float(observation[HapticObservation.HUMAN_END]), p.latency, p.seen_noise)
        hand = float(observation[HapticObservation.HAND_HEIGHT])
        felt = hand + TABLE_LENGTH * float(observation[HapticObservation.TORQUE]) / FAR_STIFFNESS
        self._correct(felt, p.touch_age, p.felt_noise)

    def _correct(self, sample: float, age: float, noise: float) -> None:
        """Update by a sample of z - age v. The motion within its age adds to its noise."""
        p = self._parameters
        a, b, c = self._variance
        walk = p.jerk * p.jerk * age**3 / 3
        innovation = sample - (self.height - age * self.velocity)
        to_height, to_velocity = a - age * b, b - age * c
        spread = to_height - age * to_velocity + noise * noise + walk
        gain, gain_velocity = to_height / spread, to_velocity / spread
        self.height += gain * innovation
        self.velocity += gain_velocity * innovation
        self._variance = (
            a - gain * to_height,
            b - gain * to_velocity,
            c - gain_velocity * to_velocity,
        )
