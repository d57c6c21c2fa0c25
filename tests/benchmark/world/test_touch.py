"""The world with touch: statics of its torques, the intention of a person, the weight of a ball."""

import math
from contextlib import closing

import numpy as np
import pytest
from colift.agents.humans import SECOND_PERSON, SUBJECTS
from colift.benchmark.episode.seat import body_parameters
from colift.benchmark.world.ball import Ball
from colift.benchmark.world.bullet_world import BulletWorld
from colift.benchmark.world.nao_end import NaoFarEnd
from colift.benchmark.world.second_human import HumanFarEnd
from colift.benchmark.world.table import (
    FAR_GRIP_DAMPING,
    FAR_GRIP_STIFFNESS,
    GRAVITY,
    GRIP_DAMPING,
    GRIP_STIFFNESS,
    TABLE_INERTIA,
    TABLE_LENGTH,
    WEIGHT_SHARE,
)

BODY = body_parameters(SUBJECTS["S3"])
REST = 300
"""Frames in which everything comes to rest."""


@pytest.fixture
def world():
    with closing(BulletWorld(BODY, NaoFarEnd(), touch=True)) as made:
        yield made


def hold(world, near, far, frames=REST, difference=0.0, pitch=0.0):
    """Hold both ends at heights [m] until everything is at rest."""
    for _ in range(frames // 10):
        world.advance([near] * 10, [far] * 10, ([difference] * 10, [pitch] * 10))


def test_the_grip_of_the_far_hands_resists_the_pitch(world):
    hold(world, 0.10, 0.05)
    pitch = math.asin((world.robot_end[-1] - world.human_end[-1]) / TABLE_LENGTH)
    assert abs(pitch) > 0.03
    implicit = 1 + 0.01 * (GRIP_DAMPING + FAR_GRIP_DAMPING) / TABLE_INERTIA / 2
    assert world.robot_torque[-1] == pytest.approx(-FAR_GRIP_STIFFNESS * pitch / implicit, rel=1e-3)


def test_wrists_that_mean_the_pitch_of_the_table_press_on_nobody(world):
    """At the intended pitch only the far grip's own resistance is left of the forces."""
    hold(world, 0.10, 0.05, difference=-0.05, pitch=-math.asin(0.05 / TABLE_LENGTH))
    pitch = math.asin((world.robot_end[-1] - world.human_end[-1]) / TABLE_LENGTH)
    left = world.robot_force[-1] - WEIGHT_SHARE
    assert left == pytest.approx(FAR_GRIP_STIFFNESS * pitch / TABLE_LENGTH, abs=0.03)


def test_the_force_at_the_far_hands_tells_the_pitch_that_the_wrists_mean(world):
    """w = p + (k_far p - F L) / k_wrist, the statics that filters build on."""
    hold(world, 0.10, 0.10, pitch=-0.04)
    pitch = math.asin((world.robot_end[-1] - world.human_end[-1]) / TABLE_LENGTH)
    force = world.robot_force[-1] - WEIGHT_SHARE
    wrist = pitch + (FAR_GRIP_STIFFNESS * pitch - force * TABLE_LENGTH) / GRIP_STIFFNESS
    assert wrist == pytest.approx(-0.04, abs=0.002)


def test_reflexes_leave_an_intended_difference_alone(world):
    """The same references reach the intended heights more nearly if the difference is intended."""
    pitch = -math.asin(0.1 / TABLE_LENGTH)
    hold(world, 0.15, 0.05, difference=-0.1, pitch=pitch)
    meant = abs(world.human_end[-1] - 0.15)
    world.reset()
    hold(world, 0.15, 0.05)
    assert meant < 0.5 * abs(world.human_end[-1] - 0.15)


def test_a_reset_restores_every_bit(world):
    hold(world, 0.1, 0.05, frames=50, difference=0.02, pitch=0.01)
    first = world.state()
    world.reset()
    hold(world, 0.1, 0.05, frames=50, difference=0.02, pitch=0.01)
    assert world.state() == first


@pytest.mark.parametrize("far", [NaoFarEnd(), HumanFarEnd(body_parameters(SECOND_PERSON))])
def test_the_weight_of_a_ball_is_shared_by_its_place(far):
    """Both ends together carry table and ball; a ball in the middle is carried in halves."""
    ball = Ball(friction=5.0)
    with closing(BulletWorld(BODY, far, ball=ball)) as made:
        for _ in range(REST // 10):
            made.advance([0.05] * 10, [0.05] * 10)
        weight = ball.mass * GRAVITY
        carried = made.human_force[-1] + made.robot_force[-1] - 2 * WEIGHT_SHARE
        assert carried == pytest.approx(weight, rel=0.02)
        lever = 0.5 + made.ball_place[-1] / TABLE_LENGTH
        far_share = made.robot_force[-1] - WEIGHT_SHARE
        assert far_share == pytest.approx(lever * weight, abs=0.08)


def test_a_ball_rolls_down_the_table():
    with closing(BulletWorld(BODY, NaoFarEnd(), ball=Ball())) as made:
        for _ in range(8):
            made.advance([0.05] * 10, [0.0] * 10)
        assert made.ball_place[-1] > 0.01
        assert made.ball_speed[-1] > 0.0
        assert np.all(np.diff(made.ball_place[-40:]) > 0.0)
