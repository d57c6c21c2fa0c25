from itertools import pairwise

import numpy as np
import pytest
from colift.robots.description.parts import mirrored_name
from colift.robots.nao.facts import (
    ARM,
    FOOT_HEIGHT,
    HIP_OFFSET_Z,
    JOINTS,
    LINKS,
    THIGH_LENGTH,
    TIBIA_LENGTH,
    TORSO_HEIGHT,
)

LEFT_JOINTS = [name for name in JOINTS if name[0] == "L" and "Hand" not in JOINTS[name].mimic]
LEFT_LINKS = [name for name in LINKS if name[0] in "Ll"]


def test_masses_are_the_published_ones() -> None:
    assert sum(link.mass for link in LINKS.values()) == pytest.approx(5.305, abs=5e-4)
    arm = sum(LINKS[JOINTS[f"L{name}"].child].mass for name in ARM)
    assert arm == pytest.approx(0.579, abs=5e-4)


def test_legs_add_up_to_the_standing_height() -> None:
    legs = HIP_OFFSET_Z + THIGH_LENGTH + TIBIA_LENGTH + FOOT_HEIGHT
    assert legs == pytest.approx(TORSO_HEIGHT, abs=5e-4)


def test_joints_make_a_tree_rooted_at_the_torso() -> None:
    reached = ["torso"]
    for joint in JOINTS.values():
        assert joint.parent in reached
        reached.append(joint.child)
    assert sorted(reached) == sorted(LINKS)


def test_there_are_25_motors() -> None:
    assert sum(not joint.mimic for joint in JOINTS.values()) == 25
    assert all(JOINTS[joint.mimic].mimic == "" for joint in JOINTS.values() if joint.mimic)


def test_inertias_are_those_of_real_bodies() -> None:
    for link in LINKS.values():
        xx, xy, xz, yy, yz, zz = link.inertia
        moments = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        assert moments[0] > 0.0, link.name
        assert moments[2] <= moments[0] + moments[1], link.name


@pytest.mark.parametrize("name", LEFT_JOINTS)
def test_right_joint_mirrors_the_left(name: str) -> None:
    left, right = JOINTS[name], JOINTS[mirrored_name(name)]
    assert np.multiply(left.origin, (1, -1, 1)) == pytest.approx(right.origin)
    assert (left.speed, left.effort) == (right.speed, right.effort)
    if left.axis[1] == 0.0 and not name.endswith("Hand"):
        assert (right.axis, right.lower, right.upper) == (left.axis, -left.upper, -left.lower)
    else:
        assert np.multiply(left.axis, (1, 1, -1)) == pytest.approx(right.axis)
        # The ankles are the one published difference.
        tolerance = 0.01 if "AnklePitch" in name else 0.0
        limits = pytest.approx((left.lower, left.upper), abs=tolerance)
        assert (right.lower, right.upper) == limits


@pytest.mark.parametrize("name", LEFT_LINKS)
def test_right_link_mirrors_the_left(name: str) -> None:
    left, right = LINKS[name], LINKS[mirrored_name(name)]
    assert left.mass == right.mass
    assert np.multiply(left.com, (1, -1, 1)) == pytest.approx(right.com)
    assert np.multiply(left.inertia, (1, -1, 1, 1, -1, 1)) == pytest.approx(right.inertia)


def test_fingers_follow_their_hand() -> None:
    fingers = [joint for joint in JOINTS.values() if joint.mimic.endswith("Hand")]
    assert len(fingers) == 16
    for first, second in pairwise(fingers):
        if second.parent == first.child:
            assert second.mimic == first.mimic
