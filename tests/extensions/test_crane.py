"""Another package's robot plays, is scored, verified, drawn and served, without an edit of ours."""

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.rendering.bodies import label_of, shown_body
from colift.benchmark.rendering.scene import Scene
from colift.benchmark.robots.robot import make_robot
from colift.benchmark.suites.catalogue import make_scenario
from colift.leaderboard.replays.geometry import geometry

from . import crane


@pytest.fixture(autouse=True)
def installed(install):
    install(crane.__file__, crane.ENTRY_POINTS)
    caches = (make_robot, geometry)
    for each in caches:
        each.cache_clear()
    yield
    for each in caches:
        each.cache_clear()


def test_it_plays_is_scored_and_verified(colift):
    done = colift("run", "copy", "--suite", "quick-v1", "--robot", "crane", "--out", "mine")
    assert done.returncode == 0, done.stderr
    assert "copy on quick-v1 (crane)" in done.stdout
    verified = colift("verify", "mine")
    assert verified.returncode == 0, verified.stdout + verified.stderr
    inspected = colift("inspect", "mine", "--worst", "1")
    assert "copy on quick-v1 (crane)" in inspected.stdout, inspected.stderr
    drawn = colift("render", "mine", "--out", "worst.png")
    assert drawn.returncode == 0, drawn.stderr


def test_its_hand_is_as_fast_as_it_says():
    seat = make_scenario("smooth", partner="crane").seat
    assert seat.action_range(0.1) == pytest.approx((-0.02, 0.02))
    assert seat.hand_commands([[0.5], [0.01]], 0.1) == pytest.approx([0.02, 0.03])


def test_it_is_drawn_and_so_is_its_arm_in_replays():
    scene = Scene("crane")
    pictures = []
    for height in (0.0, 0.3):
        scene.pose(height, height)
        pictures.append(scene.picture(160, 100))
    scene.close()
    assert not np.array_equal(*pictures)
    assert label_of("crane") == "crane"
    rows = geometry()["robots"]["crane"]["arm"]["rows"]
    assert rows[-1][-1][1] - rows[0][-1][1] == pytest.approx(0.55, abs=1e-3)


def test_it_is_listed(colift):
    assert "crane  A crane with a spring." in colift("list", "robots").stdout


def test_a_robot_that_is_not_installed_is_refused_and_has_no_picture(monkeypatch):
    with pytest.raises(InputError, match=r"partner must be one of 'crane', .*, got 'derrick'"):
        make_scenario("smooth", partner="derrick")
    assert shown_body("derrick") is None
