"""The height of the human's end from sight and touch."""

import numpy as np
import pytest
from colift.agents.tasks.agree.observation import AgreeObservation
from colift.agents.tasks.agree.touched_end import TouchedEnd
from colift.agents.tasks.touch.touched import FAR_STIFFNESS, TABLE_LENGTH


def filtered(path, *, torque=True):
    """Return the filter after a path of the human's end, the robot's hand at 0, without noise."""
    touched = TouchedEnd()
    for k in range(40):
        view = np.zeros(len(AgreeObservation))
        view[AgreeObservation.TIME] = 0.1 * k
        view[AgreeObservation.HUMAN_END] = path(0.1 * k - 0.1)
        height = path(0.1 * k - 0.01) if torque else path(0.1 * k - 0.1)
        view[AgreeObservation.TORQUE] = height * FAR_STIFFNESS / TABLE_LENGTH
        touched.update(view)
    return touched


def test_a_steady_motion_is_known_without_delay():
    touched = filtered(lambda t: 0.1 * t)
    assert touched.height == pytest.approx(0.1 * 3.9, abs=1e-3)
    assert touched.velocity == pytest.approx(0.1, abs=5e-3)


def test_touch_tells_a_start_before_it_is_seen():
    def start(t):
        return 0.2 * max(t - 3.82, 0.0)

    assert filtered(start).height > 0.004
    assert abs(filtered(start, torque=False).height) < 1e-9
