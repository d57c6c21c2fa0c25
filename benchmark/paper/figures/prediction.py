"""Figure 4: predictions of position, velocity and acceleration against the observed."""

import numpy as np

from ...rendering.palette import HUMAN
from ..derived import derivatives
from ..sampled import SampledLift
from .picture import PREDICTION, Picture, legend, panels


def prediction_picture(lift: SampledLift) -> Picture:
    """Return figure 4 from one lift."""
    velocity, acceleration = derivatives(lift)
    observed = (lift.samples, velocity, acceleration)
    names = ("prediction", "predicted_velocity", "predicted_acceleration")
    predicted = [lift.one_step_ahead(name) for name in names]
    units = ("mm", "mm/s", "mm/s²")
    figure, rows = panels(
        [f"{name} [{unit}]" for name, unit in zip(_QUANTITIES, units, strict=True)], [1.9, 1.5, 1.5]
    )
    steps = np.arange(len(lift.samples))
    for (axes,), seen, expected in zip(rows, observed, predicted, strict=True):
        axes.plot(steps, 1000 * seen, color=HUMAN, lw=2.0, label="observed")
        axes.plot(
            steps, 1000 * expected, color=PREDICTION, lw=1.4, marker=".", ms=5, label="predicted"
        )
    legend(rows[0][0])
    columns = {"step": steps.tolist()}
    for name, seen, expected in zip(_QUANTITIES, observed, predicted, strict=True):
        columns[f"observed_{name}_m"] = seen.tolist()
        columns[f"predicted_{name}_m"] = expected.tolist()
    return Picture(
        name="figure-4",
        title="Figure 4. Predictions of the Kalman filter",
        caption=f"Subject {lift.episode.subject}, seed {lift.episode.seed}. What was predicted of "
        "each sample one step (100 ms) earlier, against what was then observed; observed velocity "
        "and acceleration are central differences of the observed position. (CSV: m, m/s, m/s².)",
        figure=figure,
        columns=columns,
    )


_QUANTITIES = ("position", "velocity", "acceleration")
