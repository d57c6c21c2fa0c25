"""Subjects: the five people of the study and the population they represent."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final, Self

import numpy as np
from colift.agents.calibration import CALIBRATION
from colift.base.errors import InputError
from colift.robots.arithmetic import dot

GOAL_RANGE: Final = (0.08, 0.285)
"""Lowest and highest goal of a lift [m]: what fits the robot arm's stroke, overshoots included."""

BOUNDS: Final[Mapping[str, tuple[float, float]]] = MappingProxyType(
    {
        "amplitude": (0.15, 0.27),
        "amplitude_spread": (0.0, 0.5),
        "duration": (1.0, 4.0),
        "duration_spread": (0.0, 0.3),
        "lowering_ratio": (0.8, 1.4),
        "skew_up": (0.3, 0.7),
        "skew_down": (0.3, 0.7),
        "motor_noise": (0.0, 0.1),
        "tremor_amplitude": (0.0, 2e-3),
        "tremor_frequency": (6.0, 12.0),
        "visual_delay": (0.10, 0.25),
        "haptic_delay": (0.045, 0.12),
        "stiffness": (100.0, 800.0),
        "damping": (5.0, 30.0),
        "mass": (0.5, 2.0),
        "pull": (0.0, 0.5),
    }
)
"""Limits of each parameter, in its unit, for a healthy person.

Hand tremor lies between 6 and 12 Hz (Wade et al. 1982; Lakie et al. 2015), and 2 mm is already an
enhanced tremor. The delays span long-latency reflexes to voluntary answers, and visual corrections
to simple reactions. These and the arm's impedance are wide limits that we chose, not measurements.
"""

MOST_SUBMOVEMENTS: Final = 5


@dataclass(frozen=True, kw_only=True)
class Subject:
    """One person: parameters of motion, perception and arm.

    Raises
    ------
    InputError
        When a parameter lies outside ``BOUNDS``.
    """

    name: str
    amplitude: float
    """Mean height of a lift [m]."""
    amplitude_spread: float = 0.20
    """Half the range of the lift heights, relative to their mean."""
    duration: float
    """Mean duration of the upward stroke [s]."""
    duration_spread: float = 0.10
    """Half the range of the durations, relative to their mean."""
    lowering_ratio: float
    """Duration of the lowering relative to the upward stroke."""
    skew_up: float = 0.45
    """Relative time of the highest speed on the way up: people accelerate faster upwards."""
    skew_down: float = 0.54
    """Relative time of the highest speed on the way down."""
    submovements: tuple[int, int]
    """Lowest and highest number of extra submovements in a stroke."""
    motor_noise: float
    """Signal-dependent noise k: standard deviation of the velocity, relative to the velocity."""
    tremor_amplitude: float
    """Amplitude of the hand's physiological tremor [m]."""
    tremor_frequency: float
    """[Hz]"""
    visual_delay: float
    """Time from seeing to acting [s]."""
    haptic_delay: float
    """Time from feeling to acting [s]."""
    stiffness: float
    """Stiffness K of the arm's endpoint [N/m]."""
    damping: float
    """Damping B of the arm's endpoint [N s/m]."""
    mass: float
    """Mass M of the arm's endpoint [kg]."""
    pull: float
    """Fraction of the height difference to which the person yields; 0 ignores it."""
    felt_share: float = 0.5
    """Fraction of that pull which comes from the felt force; the rest comes from sight."""

    def __post_init__(self) -> None:
        for name, (low, high) in BOUNDS.items():
            value = getattr(self, name)
            if not low <= value <= high:
                raise InputError(
                    f"subject {self.name!r}: {name} is {value}, must be between {low} and {high}"
                )
        fewest, most = self.submovements
        if not 0 <= fewest <= most <= MOST_SUBMOVEMENTS:
            raise InputError(
                f"subject {self.name!r}: submovements is {self.submovements}, must be (lowest, "
                f"highest) with 0 <= lowest <= highest <= {MOST_SUBMOVEMENTS}"
            )

    @classmethod
    def draw(cls, seed: int) -> Self:
        """Return a new person of the population from which S1 to S5 are a sample.

        The parameters ``x = mean + sum_i g_i (x_i - mean) / sqrt(4)``, with ``x_i`` those of the
        five and ``g_i`` standard normal, have the mean and the covariance of the five: a stiff arm
        is also a heavy and well damped one. Drawn again until inside the bounds.

        Parameters
        ----------
        seed : number of the person, which is also in the name, ``draw-<seed>``.
        """
        rng = np.random.default_rng(seed)
        table = np.array([_numbers(subject) for subject in SUBJECTS.values()])
        mean = table.mean(axis=0)
        mix = (table - mean) / np.sqrt(len(table) - 1)
        while True:
            drawn = mean + dot(mix.T, rng.standard_normal(len(table)))
            *values, lowest, highest = drawn.tolist()
            fewest, most = round(lowest), round(highest)
            try:
                return cls(
                    name=f"draw-{seed}",
                    submovements=(fewest, most),
                    **dict(zip(BOUNDS, values, strict=True)),
                )
            except InputError:
                continue


def _numbers(subject: Subject) -> list[float]:
    return [*(getattr(subject, name) for name in BOUNDS), *subject.submovements]


SUBJECTS: Final[dict[str, Subject]] = {
    subject.name: subject
    for subject in (
        Subject(
            name="S1",
            amplitude=CALIBRATION.amplitude["S1"],
            duration=2.15,
            lowering_ratio=1.05,
            submovements=(0, 1),
            motor_noise=0.02,
            tremor_amplitude=0.05e-3,
            tremor_frequency=8.0,
            visual_delay=0.140,
            haptic_delay=0.060,
            stiffness=200.0,
            damping=12.0,
            mass=1.0,
            pull=0.2,
        ),
        Subject(
            name="S2",
            amplitude=CALIBRATION.amplitude["S2"],
            duration=2.10,
            lowering_ratio=1.05,
            submovements=(1, 1),
            motor_noise=0.03,
            tremor_amplitude=0.08e-3,
            tremor_frequency=9.0,
            visual_delay=0.160,
            haptic_delay=0.075,
            stiffness=300.0,
            damping=16.0,
            mass=1.2,
            pull=0.1,
        ),
        Subject(
            name="S3",
            amplitude=CALIBRATION.amplitude["S3"],
            duration=2.05,
            lowering_ratio=1.00,
            submovements=(2, 3),
            motor_noise=0.05,
            tremor_amplitude=0.15e-3,
            tremor_frequency=7.0,
            visual_delay=0.180,
            haptic_delay=0.090,
            stiffness=450.0,
            damping=20.0,
            mass=1.5,
            pull=0.1,
        ),
        Subject(
            name="S4",
            amplitude=CALIBRATION.amplitude["S4"],
            duration=2.05,
            lowering_ratio=1.10,
            submovements=(1, 1),
            motor_noise=0.03,
            tremor_amplitude=0.05e-3,
            tremor_frequency=10.0,
            visual_delay=0.150,
            haptic_delay=0.070,
            stiffness=150.0,
            damping=9.0,
            mass=0.8,
            pull=0.3,
        ),
        Subject(
            name="S5",
            amplitude=CALIBRATION.amplitude["S5"],
            duration=2.10,
            lowering_ratio=1.10,
            submovements=(1, 2),
            motor_noise=0.04,
            tremor_amplitude=0.10e-3,
            tremor_frequency=8.0,
            visual_delay=0.170,
            haptic_delay=0.080,
            stiffness=250.0,
            damping=14.0,
            mass=1.1,
            pull=0.15,
        ),
    )
}
"""The paper's five subjects by name; S1 is practised, S3 fast and irregular.

Amplitude and duration are fitted to the error level of the paper's Table I, which states neither;
the other numbers are choices within the ranges of the literature, deliberately diverse.
"""
