"""The filter of intended poses, on signals made by its own model."""

import math

import numpy as np
import pytest
from colift.agents.tasks.intent.pose_filter import SHARES, PoseFilter
from colift.agents.tasks.touch.touched import FAR_STIFFNESS, TABLE_LENGTH, WRIST_STIFFNESS


def fed(share, wrist, steps=12, follows=True):
    """Return a filter that has felt a person raise the near end by 0.1 m, with a silent sensor."""
    made = PoseFilter()
    path = 0.1 * (1 - np.cos(np.linspace(0, math.pi, steps))) / 2
    for near in [0.0] * 5 + path.tolist():
        meant = share * near
        far = meant if follows else near
        pitch = math.asin((far - near) / TABLE_LENGTH)
        turned = wrist * math.asin((meant - near) / TABLE_LENGTH)
        torque = WRIST_STIFFNESS * (turned - pitch) - FAR_STIFFNESS * pitch
        made.update(near, pitch, -torque / TABLE_LENGTH)
    return made


@pytest.mark.parametrize("share", SHARES)
def test_wrists_that_show_all_tell_the_intent(share):
    made = fed(share, 1.0, follows=False)
    assert made.intents[SHARES.index(share)] > 0.5
    assert made.height == pytest.approx(share * 0.1, abs=0.03)


def test_a_quarter_shown_of_a_turn_is_not_told_from_half_shown_of_a_pivot():
    turn, pivot = fed(-1.0, 0.25, follows=False), fed(0.0, 0.5, follows=False)
    assert turn.intents == pytest.approx(pivot.intents, abs=0.01)
    assert turn.height == pytest.approx(pivot.height, abs=0.005)


def test_at_first_every_intent_is_as_likely():
    made = PoseFilter()
    assert made.intents == pytest.approx([1 / 3] * 3)
    assert made.height == 0.0


def test_a_person_who_waits_makes_the_present_pose_less_likely():
    """With the same torque, standing still for long shifts the expected height away from here."""
    made = fed(0.0, -0.1, follows=False)
    near = 0.1
    pitch = 0.0
    torque = -WRIST_STIFFNESS * 0.1 * math.asin(-0.1 / TABLE_LENGTH)
    before = made.height
    assert made.intents.argmax() == 0
    for _ in range(15):
        made.update(near, pitch, -torque / TABLE_LENGTH)
    assert made.height < 0.5 * before
    assert made.intents.argmax() == 1


def test_no_signal_makes_it_lose_its_numbers():
    made = PoseFilter()
    for near, pitch, force in [(0.3, 0.5, 40.0), (-0.3, -0.5, -40.0), (0.0, 0.0, 0.0)] * 5:
        made.update(near, pitch, force)
        assert math.isfinite(made.height)
        assert made.intents.sum() == pytest.approx(1.0)
