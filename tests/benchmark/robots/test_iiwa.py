"""The torque-controlled arm: its postures, its stiffness, its repeatability."""

import contextlib

import numpy as np
import pytest
from colift.agents.humans import SUBJECTS
from colift.agents.policies.copy import Copy
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.seat import body_parameters
from colift.benchmark.robots.iiwa import EFFORT, ROW, STROKE, Iiwa, postures
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.world.bullet import pybullet
from colift.benchmark.world.bullet_world import BulletWorld

BODY = body_parameters(SUBJECTS["S3"])


@pytest.fixture
def world():
    with contextlib.closing(BulletWorld(BODY, Iiwa())) as made:
        yield made


def test_postures_follow_one_another_along_the_whole_stroke():
    rows = np.array(postures())
    assert len(rows) == round((STROKE[1] - STROKE[0]) / ROW) + 1
    assert np.abs(np.diff(rows, axis=0)).max() < 0.02
    assert np.abs(rows[:, [0, 2, 4]]).max() < 1e-4  # It stays in the plane of the table.


@pytest.mark.parametrize("height", [0.0, 0.1, 0.25, 0.35])
def test_it_holds_the_table_where_it_is_told_and_yields_a_little(world, height):
    steps = np.linspace(0.0, height, 200).tolist() + [height] * 300
    for first in range(0, len(steps), 10):
        world.advance(steps[first : first + 10], steps[first : first + 10])
    assert world.robot_end[-1] == pytest.approx(height, abs=0.002)
    assert world.hand_height == pytest.approx(world.robot_end[-1], abs=1e-4)
    assert abs(world.robot_velocity[-1]) < 1e-3
    # A person who pulls down moves it by the force over some thousand N/m.
    before, force = world.robot_end[-1], world.robot_force[-1]
    for _ in range(30):
        world.advance([height - 0.1] * 10, [height] * 10)
    moved, pulled = before - world.robot_end[-1], world.robot_force[-1] - force
    assert abs(moved) < 0.005
    assert abs(pulled) < 20


def test_a_lift_repeats_itself_bit_for_bit_and_torques_stay_within_those_of_the_joints(monkeypatch):
    scenario, largest, control = make_scenario("jerky", "S2", partner="iiwa"), [], []
    original = pybullet.setJointMotorControlArray

    def noting(body, joints, mode, *more, **named):
        if len(joints) == len(EFFORT) and mode == pybullet.TORQUE_CONTROL:
            largest.append(np.abs(named["forces"]).max())
            control.append(np.abs(named["forces"]) - EFFORT)
        return original(body, joints, mode, *more, **named)

    monkeypatch.setattr(pybullet, "setJointMotorControlArray", noting)
    traces = []
    for _ in range(2):
        with contextlib.closing(Lift(scenario)) as lift:
            traces.append(run_episode(lift, Copy(), 3).trace.digest())
    assert traces[0] == traces[1]
    assert np.max(control) <= 0.0
    assert 5.0 < max(largest) < 100.0
