"""Parameters calibrated to the paper's Table I.

``colift calibrate`` fits them on seeds of its own and writes ``calibration.json`` beside this file,
with their provenance. None of them is specific to a policy.
"""

import json
from dataclasses import dataclass
from importlib.resources import files
from typing import Any, Final


@dataclass(frozen=True, kw_only=True)
class Calibration:
    """Numbers that the paper does not state, fitted to its results."""

    amplitude: dict[str, float]
    """Mean height of each subject's lifts [m]."""
    process_noise: float
    """q of the motion filter [mm2/s6]."""
    partner_lag: float
    """Lag of the partner, the second of two people [s]."""
    provenance: dict[str, Any]
    """Method, data and result of the fit."""


def _load() -> Calibration:
    content = json.loads(files(__package__).joinpath("calibration.json").read_text())
    return Calibration(
        amplitude=content["amplitude_m"],
        process_noise=content["process_noise_mm2_s6"],
        partner_lag=content["partner_lag_s"],
        provenance=content["provenance"],
    )


CALIBRATION: Final = _load()
