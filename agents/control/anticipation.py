"""The learned forecast of a human's motion: its features, its perceptron and its outputs."""

from dataclasses import asdict, dataclass, field
from functools import cache
from importlib.resources import files
from typing import Any, Final, NamedTuple

import numpy as np
from colift.agents.agent import Observation, RobotObservation
from colift.agents.control.learned import learned_json, load_learned, read_learned
from colift.agents.estimators.perceptron import Perceptron
from colift.base.errors import InputError
from numpy.typing import NDArray

Array = NDArray[np.float64]

ARM_LAG: Final = 0.02
"""Time by which the arm is behind its command [s]: one cycle of the NAO's motion thread."""

MODES: Final = ("rest", "onset", "stroke", "pause", "reversal")
"""Modes of motion, by the velocities now and a little later: still and still; still, then moving;
moving on; moving, then still; moving, then in the opposite direction."""


@dataclass(frozen=True, kw_only=True)
class FeatureWindow:
    """Extent of the past that the features describe.

    Raises
    ------
    InputError
        If there is no velocity, or a number is out of range.
    """

    interval: float = 0.1
    """Time between the values of the past [s]."""
    velocities: int = 20
    """Past velocities of the human's end."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        if not 0 < self.interval < np.inf:
            raise InputError(f"interval must be a positive time, got {self.interval}")
        if self.velocities < 1:
            raise InputError(f"a window needs at least 1 velocity, got {self.velocities}")

    @property
    def size(self) -> int:
        """Number of features."""
        return 1 + self.velocities


class FeatureHistory:
    """Recent observations, and the features computed from them.

    With z the seen heights of the human's end and dt the window's interval, the features are

        z(-0), z(-0) - z(-dt), z(-dt) - z(-2 dt), ...

    with times relative to now, and z(-0) the newest sample, which is a latency old. Heights are
    interpolated between samples; before the first sample, the first height is held.
    """

    def __init__(self, window: FeatureWindow) -> None:
        self._window = window
        self._keep = window.interval * (window.velocities + 1)
        self._times: list[float] = []
        self._heights: list[float] = []
        self._commands: list[float] = []
        self._sag = 0.0

    def add(self, observation: Observation) -> None:
        """Add the newest observation, and forget those that the window no longer needs."""
        time = float(observation[RobotObservation.TIME])
        while len(self._times) > 1 and self._times[1] < time - self._keep:
            for values in (self._times, self._heights, self._commands):
                del values[0]
        self._times.append(time)
        self._heights.append(float(observation[RobotObservation.HUMAN_END]))
        self._commands.append(float(observation[RobotObservation.HAND_COMMAND]))
        expected = float(np.interp(time - ARM_LAG, self._times, self._commands))
        self._sag = expected - float(observation[RobotObservation.HAND_HEIGHT])

    @property
    def time(self) -> float:
        """Time of the newest observation [s]."""
        return self._times[-1]

    @property
    def height(self) -> float:
        """Newest seen height of the human's end [m]."""
        return self._heights[-1]

    @property
    def sag(self) -> float:
        """Height of the command :data:`ARM_LAG` ago above the hand now [m]: the load's effect."""
        return self._sag

    def period(self, default: float) -> float:
        """Return the time between the last two observations [s]; the default for fewer than two."""
        return self._times[-1] - self._times[-2] if len(self._times) > 1 else default

    def command(self, age: float) -> float:
        """Return the robot's command ``age`` [s] ago [m]."""
        return float(np.interp(self._times[-1] - age, self._times, self._commands))

    def features(self) -> Array:
        """Return the features, shape ``(window.size,)`` [m]."""
        ages = self._window.interval * np.arange(self._window.size)
        heights = np.interp(self._times[-1] - ages, self._times, self._heights)
        return np.concatenate((heights[:1], heights[:-1] - heights[1:]))


class Forecast(NamedTuple):
    """Expected motion of the human from now on."""

    rises: Array
    """(m,) mean rise of the human's end above its newest seen height, at each of the leads [m]."""
    modes: Array
    """(5,) probabilities of the :data:`MODES`."""
    stroke_rise: float
    """Mean rise from the newest seen height to the end of the stroke in progress [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Anticipation:
    """A perceptron from features of the seen motion to a forecast.

    Raises
    ------
    InputError
        If the parts do not fit together.
    """

    perceptron: Perceptron
    """From the features of :class:`FeatureHistory` to rises at the leads [m], probabilities of the
    modes and the rise of the stroke [m], in this order; see :class:`Forecast`."""
    window: FeatureWindow
    """Extent of its features."""
    leads: Array
    """(m,) times from now [s], increasing."""
    latency: float = 0.1
    """Age of the seen heights in the training data [s]."""
    provenance: dict[str, Any] = field(default_factory=dict)
    """Training data and method."""

    def __post_init__(self) -> None:
        """Check that the parts fit together."""
        sizes = len(self.perceptron.centre), len(self.perceptron.gain)
        wanted = self.window.size, len(self.leads) + len(MODES) + 1
        if sizes != wanted:
            raise InputError(
                f"the window and {len(self.leads)} leads need a perceptron of {wanted[0]} inputs "
                f"and {wanted[1]} outputs, got {sizes[0]} and {sizes[1]}"
            )
        if len(self.leads) < 2 or not (np.diff(self.leads) > 0).all():
            raise InputError(f"leads must increase, got {self.leads.tolist()}")

    def forecast(self, features: Array) -> Forecast:
        """Return the forecast for the features of :class:`FeatureHistory`.

        The modes were learned by least squares on ones and zeros, whose mean is a probability;
        outputs outside [0, 1] are clipped, and the sum is scaled to one.
        """
        outputs = self.perceptron(features)
        count = len(self.leads)
        modes = np.clip(outputs[count:-1], 1e-6, 1.0)
        return Forecast(outputs[:count], modes / modes.sum(), float(outputs[-1]))


def anticipation_json(anticipation: Anticipation) -> str:
    """Return the content of a file for :func:`read_anticipation`."""
    return learned_json(
        {
            "window": asdict(anticipation.window),
            "leads_s": anticipation.leads.tolist(),
            "latency_s": anticipation.latency,
            "perceptron": anticipation.perceptron.plain(),
            "provenance": anticipation.provenance,
        }
    )


def read_anticipation(text: str) -> Anticipation:
    """Return the anticipation of :func:`anticipation_json`.

    Raises
    ------
    InputError
        As :func:`.read_learned`.
    """
    return read_learned(text, _from_parts, "an anticipation")


@cache
def load_anticipation(path: str | None = None) -> Anticipation:
    """Return the anticipation of a file; without a path, the shipped one.

    Raises
    ------
    InputError
        As :func:`.load_learned`.
    """
    shipped = files(__package__).joinpath("data", "anticipate.json")
    return load_learned(path, shipped, read_anticipation)


def _from_parts(parts: Any) -> Anticipation:
    return Anticipation(
        perceptron=Perceptron.of(parts["perceptron"]),
        window=FeatureWindow(**parts["window"]),
        leads=np.array(parts["leads_s"], dtype=np.float64),
        latency=float(parts["latency_s"]),
        provenance=parts["provenance"],
    )
