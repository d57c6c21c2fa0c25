"""Figure 7: what the forgetting factor does, computed offline from one recorded lift."""

from collections.abc import Sequence

import numpy as np

from ...rendering.palette import HUMAN, INK
from ..measures import fluctuation
from ..published import FORGETTING_FACTORS
from ..replay import confidence_course, replay
from ..sampled import SampledLift
from ..settling import settling
from .picture import CONFIDENCE, Picture, panels, shade


def forgetting_picture(lift: SampledLift) -> Picture:
    """Return figure 7 from one lift with a long pause."""
    replayed = replay(lift.samples, lift.scenario.control_period)
    start, stop = (lift.step_showing(lift.event(event)) for event in ("pause", "resume"))
    figure, rows = panels(
        ["position [mm]", *(f"φ = {phi:.2f}" for phi in FORGETTING_FACTORS)],
        [1.3, *[0.8] * len(FORGETTING_FACTORS)],
    )
    steps = np.arange(len(lift.samples))
    shade(rows[0][0], [(start, stop)])
    rows[0][0].plot(steps, 1000 * lift.samples, color=HUMAN, lw=2.0)
    columns: dict[str, Sequence[float]] = {
        "step": steps.tolist(),
        "observed_position_m": lift.samples.tolist(),
        "likelihood": replayed.likelihood.tolist(),
    }
    for (axes,), phi in zip(rows[1:], FORGETTING_FACTORS, strict=True):
        course = confidence_course(replayed.likelihood, phi)
        columns[f"confidence_phi_{phi:.2f}"] = course.tolist()
        shade(axes, [(start, stop)])
        axes.plot(steps, course, color=CONFIDENCE, lw=1.8)
        axes.set_ylim(-0.05, 1.08)
        axes.annotate(
            f"fluctuation {fluctuation(course):.3f} a step, settles in {settling(lift, phi)} steps",
            (stop - 1, 0.12),
            ha="right",
            fontsize=8.5,
            color=INK,
        )
    return Picture(
        name="figure-7",
        title="Figure 7. Effect of the forgetting factor on confidence",
        caption=f"Subject {lift.episode.subject}, seed {lift.episode.seed}: one recorded lift with "
        "a long rest half way (shaded), its confidence computed offline for each forgetting "
        "factor. A low one follows every likelihood; a high one takes seconds to notice anything. "
        "Fluctuation is the root mean square change of C from one step to the next over the lift; "
        "settling is the time from the human's standstill until C first comes within 5 % of its "
        "value at rest.",
        figure=figure,
        columns=columns,
    )
