import math

import numpy as np
import pytest
from colift.agents.humans import SUBJECTS
from colift.benchmark.rendering.scene import FLOOR
from colift.leaderboard.replays.geometry import CLOTHES, PAINTS, geometry
from colift.robots.nao.facts import TORSO_HEIGHT
from colift.robots.nao.kinematics import GRIP_X, REST_Z, STROKE


def arm(which):
    table = geometry()[which]["arm"]
    heights = [table["lowest"] + i * table["step"] for i in range(len(table["rows"]))]
    return np.array(heights), np.array(table["rows"])


def test_the_hands_of_the_nao_hold_the_table_at_every_height():
    heights, rows = arm("nao")
    assert (heights[0], heights[-1]) == pytest.approx(STROKE)
    assert rows[:, 3, 0] == pytest.approx(np.full(len(rows), GRIP_X), abs=1e-4)
    assert rows[:, 3, 1] == pytest.approx(REST_Z + heights, abs=1e-4)


def test_the_nao_bends_no_link():
    _, rows = arm("nao")
    # Seen from the side no link is longer than it is.
    upper = np.hypot(*(rows[:, 1] - rows[:, 0]).T)
    assert upper.max() <= math.hypot(0.105, 0.015) + 1e-4
    assert np.ptp(rows[:, 0], axis=0).max() == 0.0


def test_the_hands_of_the_person_hold_the_table_at_every_height():
    heights, rows = arm("person")
    assert rows[:, 3, 0] == pytest.approx(np.zeros(len(rows)), abs=1e-4)
    assert rows[:, 3, 1] + FLOOR == pytest.approx(REST_Z + heights, abs=1e-4)
    assert heights[-1] > max(subject.amplitude for subject in SUBJECTS.values()) + 0.05


def test_the_nao_stands_on_its_pedestal():
    shapes = [shape for link in geometry()["nao"]["body"] for shape in link]
    lowest = min(z - height / 2 for _, z, _, height, _, _, _ in shapes)
    assert lowest == pytest.approx(-TORSO_HEIGHT, abs=0.002)
    assert geometry()["floor"] + geometry()["pedestal"] == pytest.approx(-TORSO_HEIGHT, abs=1e-4)


def test_every_colour_has_a_name_in_the_style():
    from colift.leaderboard.replays.html import STYLE, _static

    for name in (*PAINTS.values(), *CLOTHES.values()):
        assert f".paint-{name} " in _static(STYLE)
