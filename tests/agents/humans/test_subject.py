import dataclasses

import numpy as np
import pytest
from colift.agents.humans import BOUNDS, GOAL_RANGE, SUBJECTS, Subject
from colift.base.errors import InputError

DRAWN = [Subject.draw(seed) for seed in range(300)]


def test_the_five_are_named_by_their_key():
    assert list(SUBJECTS) == ["S1", "S2", "S3", "S4", "S5"]
    assert all(subject.name == name for name, subject in SUBJECTS.items())


@pytest.mark.parametrize("parameter", BOUNDS)
def test_drawn_people_stay_in_the_bounds_and_resemble_the_five(parameter):
    low, high = BOUNDS[parameter]
    drawn = np.array([getattr(subject, parameter) for subject in DRAWN])
    five = np.array([getattr(subject, parameter) for subject in SUBJECTS.values()])
    assert low <= drawn.min()
    assert drawn.max() <= high
    spread = five.std(ddof=1)
    assert abs(drawn.mean() - five.mean()) <= 0.3 * spread + 1e-12
    assert 0.6 * spread <= drawn.std() + 1e-12
    assert drawn.std() <= 1.1 * spread + 1e-12


def test_drawn_arms_are_damped_like_the_five():
    def ratio(subject):
        return subject.damping / (2.0 * np.sqrt(subject.stiffness * subject.mass))

    five = [ratio(subject) for subject in SUBJECTS.values()]
    drawn = [ratio(subject) for subject in DRAWN]
    assert min(drawn) > min(five) - 0.1
    assert max(drawn) < max(five) + 0.15


def test_a_drawn_person_depends_on_the_seed_alone():
    assert Subject.draw(17) == DRAWN[17]
    assert Subject.draw(17).name == "draw-17"
    unnamed = {dataclasses.replace(subject, name="") for subject in DRAWN}
    assert len(unnamed) == len(DRAWN)


def test_submovements_of_drawn_people_are_ordered_counts():
    assert all(0 <= low <= high for low, high in (s.submovements for s in DRAWN))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"amplitude": 0.4}, r"'S1': amplitude is 0.4, must be between 0.15 and 0.27"),
        ({"stiffness": float("nan")}, r"stiffness is nan, must be between"),
        ({"submovements": (2, 1)}, r"submovements is \(2, 1\), must be"),
        ({"submovements": (0, 99)}, r"submovements is \(0, 99\), must be"),
    ],
)
def test_an_impossible_person_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        dataclasses.replace(SUBJECTS["S1"], **change)


def test_a_subject_cannot_be_changed():
    with pytest.raises(dataclasses.FrozenInstanceError):
        SUBJECTS["S1"].amplitude = 0.1


def test_mean_amplitudes_leave_room_in_the_goal_range():
    low, high = BOUNDS["amplitude"]
    assert GOAL_RANGE[0] < low
    assert high < GOAL_RANGE[1]
