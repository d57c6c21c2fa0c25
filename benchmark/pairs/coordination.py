"""How two people move the two ends of a table: the measures of one lift.

They are computed alike from recorded pairs and from simulated lifts.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final, NamedTuple

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode import metrics
from colift.benchmark.pairs.following import SMOOTHING, cubic, following
from colift.benchmark.statistics import FloatArray

COARSE: Final = 0.75
"""Width of the smoothing kernel, relative to the interval of samples that are coarser."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Ends:
    """The two ends of a table in one lift, n samples."""

    times: FloatArray
    """[s], increasing, shape (n,)."""
    near: FloatArray
    """Height of the end whose hand was recorded [m]."""
    far: FloatArray
    """Height of the other end [m], from the same origin."""
    tilts: FloatArray | None = None
    """Inclination of the table [deg], positive if the near end is the higher one; None if it was
    not measured."""
    length: float | None = None
    """Distance between the ends [m]; None if it is not known."""
    force: FloatArray | None = None
    """Vertical force at the near hand [N]; None if it was not measured."""
    phases: tuple[str, ...] = ()
    """Name of the part of the lift in each sample, empty between two; empty if there are none."""


@dataclass(frozen=True, kw_only=True)
class Coordination:
    """The measures of a lift by name; NaN for one that it does not have."""

    rmse_mm: float
    rmse_about_mean_mm: float
    mean_difference_mm: float
    mean_tilt_deg: float
    lag_ms: float
    abs_lag_ms: float
    gain: float
    start_difference_mm: float
    force_n: float
    rmse_mm_by_phase: Mapping[str, float] = field(default_factory=dict)
    """RMSE in each part of the lift that has a name [mm]."""

    def values(self) -> dict[str, float]:
        """Return all measures by name, those of :data:`MEASURES` and then the phases."""
        own = {name: getattr(self, name) for name in MEASURES}
        return own | {phase_name(phase): x for phase, x in self.rmse_mm_by_phase.items()}

    def plain(self) -> dict[str, float | None]:
        """Return all measures for JSON: None for those that there are not."""
        return {name: None if math.isnan(x) else round(x, 6) for name, x in self.values().items()}


def phase_name(phase: str) -> str:
    """Return the name of the RMSE in a part of the lift."""
    return f"rmse_mm in {phase}"


class Measure(NamedTuple):
    """A measure in words."""

    label: str
    unit: str
    digits: int
    meaning: str


MEASURES: Final = {
    "rmse_mm": Measure(
        "RMSE",
        "mm",
        2,
        "root mean square of the height difference of the ends, the score of a robot",
    ),
    "rmse_about_mean_mm": Measure(
        "about the mean",
        "mm",
        2,
        "the same about the lift's mean difference, so without a table that is held inclined",
    ),
    "mean_difference_mm": Measure(
        "mean difference", "mm", 2, "mean of the near end's height above the far one's"
    ),
    "mean_tilt_deg": Measure(
        "mean tilt", "deg", 2, "mean inclination, positive if the near end is higher"
    ),
    "lag_ms": Measure("lag", "ms", 1, "delay of the far end, negative if it leads"),
    "abs_lag_ms": Measure("lag, either way", "ms", 1, "its size, whoever leads"),
    "gain": Measure("gain", "", 3, "movement of the far end over that of the near one"),
    "start_difference_mm": Measure(
        "difference at start",
        "mm",
        2,
        "height difference at the start, by the fit of lag and gain",
    ),
    "force_n": Measure(
        "force", "N", 2, "root mean square of the near hand's vertical force about its mean"
    ),
}
"""The measures, by name."""


def measure_of(name: str) -> Measure:
    """Return a measure in words, by its name in :meth:`Coordination.values`."""
    known = MEASURES.get(name)
    if known is not None:
        return known
    phase = name.removeprefix(phase_name(""))
    return Measure(f"RMSE in {phase}", "mm", 2, "")


def coordination(ends: Ends) -> Coordination:
    """Return the measures of a lift.

    Heights are interpolated to 100 Hz. RMSE and mean count every frame alike, rest included; lag,
    gain and difference at the start are those of :func:`.following`.
    """
    count = int((ends.times[-1] - ends.times[0]) / FRAME + 1e-6) + 1
    at = np.minimum(ends.times[0] + FRAME * np.arange(count), ends.times[-1])
    near, far = (cubic(ends.times, heights, at) for heights in (ends.near, ends.far))
    mean = float((near - far).mean())
    interval = float(np.median(np.diff(ends.times)))
    found = following(near, far, max(SMOOTHING, COARSE * interval))
    return Coordination(
        rmse_mm=metrics.rmse_mm(near, far),
        rmse_about_mean_mm=metrics.rmse_about_mean_mm(near, far),
        mean_difference_mm=1000.0 * mean,
        mean_tilt_deg=_tilt(ends, mean),
        lag_ms=1000.0 * found.delay,
        abs_lag_ms=1000.0 * abs(found.delay),
        gain=found.gain,
        start_difference_mm=1000.0 * found.difference,
        force_n=math.nan if ends.force is None else float(ends.force.std()),
        rmse_mm_by_phase=_by_phase(ends, at, near, far),
    )


def _by_phase(ends: Ends, at: FloatArray, near: FloatArray, far: FloatArray) -> dict[str, float]:
    if not ends.phases:
        return {}
    samples = np.searchsorted(ends.times, at, side="right") - 1
    names = np.array(ends.phases)[samples]
    return {
        phase: metrics.rmse_mm(near[names == phase], far[names == phase])
        for phase in dict.fromkeys(names.tolist())
        if phase
    }


def _tilt(ends: Ends, difference: float) -> float:
    """Return the mean inclination of the table [deg], measured or by its length."""
    if ends.tilts is not None:
        return float(ends.tilts.mean())
    if ends.length is None or abs(difference) > ends.length:
        return math.nan
    return math.degrees(math.asin(difference / ends.length))
