"""The world: coupling, sag, limits of the motors, determinism, convergence."""

import dataclasses
import math

import numpy as np
import pytest
from colift.agents.actions import HAND_SPEED
from colift.agents.agent import FRAME
from colift.benchmark.world.bullet_world import BulletWorld
from colift.benchmark.world.engine import DIRECT
from colift.benchmark.world.human_body import REFLEX_LIMIT, BodyParameters
from colift.benchmark.world.interface import since_reset
from colift.benchmark.world.nao_end import NaoFarEnd
from colift.benchmark.world.physics import Physics
from colift.benchmark.world.second_human import HumanFarEnd
from colift.benchmark.world.servo import Servo
from colift.benchmark.world.table import (
    GRAVITY,
    GRIP_STIFFNESS,
    TABLE_LENGTH,
    TABLE_MASS,
    WEIGHT_SHARE,
)

BODY = BodyParameters(
    stiffness=250.0, damping=14.0, mass=1.1, pull=0.0, visual_delay=0.16, haptic_delay=0.08
)
PULLED = dataclasses.replace(BODY, pull=0.3)
SETTLE = 300


def ramp(height: float, frames: int = 150) -> list[float]:
    """Rise to a height along a cosine, then stay."""
    rise = height * (1 - np.cos(np.linspace(0, math.pi, frames))) / 2
    return [*rise.tolist(), *[height] * SETTLE]


@pytest.fixture
def nao():
    world = BulletWorld(BODY, NaoFarEnd())
    yield world
    world.close()


@pytest.fixture
def humans():
    world = BulletWorld(BODY, HumanFarEnd(BODY))
    yield world
    world.close()


class TestRest:
    @pytest.mark.parametrize("partner", ["nao", "humans"])
    def test_stays_level_and_shares_the_weight_evenly(self, partner, request):
        world = request.getfixturevalue(partner)
        world.advance([0.0] * SETTLE, [0.0] * SETTLE)
        assert abs(world.human_end[-1]) < 1e-3
        assert abs(world.robot_end[-1]) < 1.5e-3
        assert world.human_force[-1] == pytest.approx(WEIGHT_SHARE, abs=0.05)
        total = world.human_force[-1] + world.robot_force[-1]
        assert total == pytest.approx(TABLE_MASS * GRAVITY, rel=1e-6)

    @pytest.mark.parametrize("height", [-0.02, 0.05, 0.13, 0.20, 0.28])
    def test_both_ends_follow_to_every_height_of_the_stroke(self, nao, height):
        nao.advance(ramp(height), ramp(height))
        assert nao.human_end[-1] == pytest.approx(height, abs=2e-3)
        assert nao.robot_end[-1] == pytest.approx(height, abs=5e-3)


class TestCoupling:
    def test_a_height_difference_is_felt_as_newtons_and_millimetres(self, nao):
        still = [0.0] * len(ramp(0.06))
        nao.advance(still, ramp(0.06))
        tilt = math.asin((nao.robot_end[-1] - nao.human_end[-1]) / TABLE_LENGTH)
        # The grip's torque is balanced by a pair of forces at the two ends.
        expected = GRIP_STIFFNESS * tilt / TABLE_LENGTH
        assert nao.human_force[-1] - WEIGHT_SHARE == pytest.approx(-expected, rel=0.05)
        assert 0.5 < expected < 2.0
        lifted = nao.human_end[-1]
        assert lifted == pytest.approx(expected / BODY.stiffness, rel=0.1)
        assert 0.002 < lifted < 0.008

    def test_the_human_moves_the_nao_a_little_and_the_nao_the_human_more(self, nao):
        """The servo is stiffer than the arm."""
        moved = ramp(0.06)
        still = [0.0] * len(moved)
        nao.advance(still, moved)
        human_given = abs(nao.human_end[-1])
        nao.reset()
        nao.advance(moved, still)
        robot_given = abs(nao.robot_end[-1])
        assert 0.0002 < robot_given < human_given / 2

    def test_two_equal_humans_share_a_difference_evenly(self, humans):
        moved = ramp(0.06)
        still = [0.0] * len(moved)
        humans.advance(moved, still)
        assert humans.robot_end[-1] == pytest.approx(0.06 - humans.human_end[-1], rel=0.02)

    def test_a_pull_towards_level_evens_out_a_part_of_the_difference(self):
        given = []
        for body in (BODY, PULLED):
            world = BulletWorld(body, NaoFarEnd())
            world.advance([0.0] * len(ramp(0.05)), ramp(0.05))
            given.append(world.human_end[-1])
            world.close()
        assert given[0] < given[1] <= given[0] + REFLEX_LIMIT

    def test_a_reflex_needs_its_delay(self):
        """Up to the shortest delay a pulled body moves exactly as one without reflexes."""
        paths = []
        for body in (BODY, PULLED):
            world = BulletWorld(body, NaoFarEnd())
            world.advance([0.0] * 60, [0.05] * 60)
            paths.append(since_reset(world.human_end))
            world.close()
        differs = np.flatnonzero(paths[0] != paths[1])
        assert differs[0] > round(BODY.haptic_delay / 0.01)

    def test_a_stiffer_arm_is_moved_less(self):
        given = []
        for stiffness in (150.0, 450.0):
            world = BulletWorld(dataclasses.replace(BODY, stiffness=stiffness), NaoFarEnd())
            world.advance([0.0] * len(ramp(0.06)), ramp(0.06))
            given.append(world.human_end[-1])
            world.close()
        assert given[1] < given[0] / 2


class TestServo:
    def test_without_the_weight_offset_the_hands_sag_by_millimetres(self, nao):
        """As in the paper, where an offset had to be added for the table's weight."""
        sagging = BulletWorld(BODY, NaoFarEnd(Servo(weight_offset=False)))
        for world in (nao, sagging):
            world.advance([0.0] * SETTLE, [0.0] * SETTLE)
        assert 0.002 < nao.robot_end[-1] - sagging.robot_end[-1] < 0.010
        sagging.close()

    def test_a_softer_servo_sags_more(self):
        sag = []
        for stiffness in (36.0, 9.0):
            servo = Servo(stiffness=stiffness, weight_offset=False)
            world = BulletWorld(BODY, NaoFarEnd(servo))
            world.advance([0.0] * SETTLE, [0.0] * SETTLE)
            sag.append(-world.robot_end[-1])
            world.close()
        assert sag[1] > 3 * sag[0]

    def test_a_load_makes_them_give_way(self, nao):
        """A human who pushes the far end down, through the grip's torque, finds it yielding."""
        nao.advance([0.0] * SETTLE, [0.0] * SETTLE)
        free = nao.robot_end[-1]
        nao.reset()
        nao.advance(ramp(0.15), [0.0] * len(ramp(0.15)))
        assert nao.robot_force[-1] < WEIGHT_SHARE
        assert nao.robot_end[-1] - free > 0.0005

    def test_encoders_agree_with_the_table_end(self, nao):
        nao.advance(ramp(0.2), ramp(0.2))
        assert nao.hand_height == pytest.approx(nao.robot_end[-1], abs=1e-3)

    def test_the_motors_are_slower_than_a_jump(self, nao):
        """A command that jumps by 0.2 m is followed within the joints' torque, not at once."""
        nao.advance([0.0] * 30, [0.2] * 30)
        rise = since_reset(nao.robot_end)
        assert rise[0] < 0.1
        assert rise[-1] > 0.15


class TestDeterminism:
    def play(self, world):
        world.reset()
        world.advance(ramp(0.2), ramp(0.15))
        return [
            since_reset(history).tobytes()
            for history in (world.human_end, world.robot_end, world.human_force)
        ]

    @pytest.mark.parametrize("partner", ["nao", "humans"])
    def test_a_reused_world_equals_a_fresh_one_bit_for_bit(self, partner, request):
        world = request.getfixturevalue(partner)
        first = self.play(world)
        world.reset()
        world.advance([0.3] * 40, [0.25, -0.02] * 20)
        assert self.play(world) == first
        fresh = BulletWorld(BODY, HumanFarEnd(BODY) if partner == "humans" else NaoFarEnd())
        assert self.play(fresh) == first
        fresh.close()

    def test_worlds_side_by_side_do_not_disturb_each_other(self, nao):
        alone = self.play(nao)
        other = BulletWorld(PULLED, NaoFarEnd())
        nao.reset()
        for human, robot in zip(ramp(0.2), ramp(0.15), strict=True):
            nao.advance([human], [robot])
            other.advance([0.1], [0.2])
        other.close()
        assert since_reset(nao.human_end).tobytes() == alone[0]


def turns(seed: int, hold: int, speed: float, frames: int = 400) -> list[float]:
    """Go up or down at a speed [m/s], drawn anew every ``hold`` frames, within the stroke."""
    ways = np.random.default_rng(seed).choice([-speed, speed], frames // hold).repeat(hold)
    heights = [0.1]
    for way in ways:
        heights.append(min(max(heights[-1] + way * FRAME, -0.02), 0.28))
    return heights


class TestArms:
    @pytest.mark.parametrize("weight_offset", [True, False])
    def test_one_arm_moves_as_two(self, weight_offset):
        """To the compliance of the solver, against a person with other plans, at the largest speed.

        Beyond that speed, at the limits of the motors, two arms need not stay mirror images.
        """
        worlds = [
            BulletWorld(PULLED, NaoFarEnd(Servo(weight_offset=weight_offset), apart=apart))
            for apart in (False, True)
        ]
        for world in worlds:
            world.advance(turns(1, 40, 0.15), turns(2, 10, HAND_SPEED))
        one, two = (since_reset(world.robot_end) for world in worlds)
        assert np.abs(one - two).max() < 2e-9
        one_force, two_force = (since_reset(world.robot_force) for world in worlds)
        assert np.abs(one_force - two_force).max() < 1e-5
        assert abs(worlds[0].hand_height - worlds[1].hand_height) < 2e-9
        assert np.ptp(one) > 0.1
        assert np.ptp(one_force) > 10
        for world in worlds:
            world.close()


class TestConvergence:
    @pytest.mark.parametrize("far_end", [NaoFarEnd(), HumanFarEnd(BODY)])
    def test_the_default_step_is_near_a_fine_one(self, far_end):
        lag = 15
        human = ramp(0.2)
        robot = [0.0] * lag + human[:-lag]
        rmse = []
        for physics in (Physics(), Physics(step=0.0005)):
            world = BulletWorld(PULLED, far_end, physics=physics)
            world.advance(human, robot)
            gap = since_reset(world.human_end) - since_reset(world.robot_end)
            rmse.append(float(np.sqrt(np.mean(gap**2))))
            world.close()
        assert rmse[0] == pytest.approx(rmse[1], rel=0.015)

    def test_the_direct_solver_is_where_iterations_lead(self):
        """An arm that holds the table closes a loop with redundant constraints: the hard case."""
        heights = []
        for physics in (Physics(), Physics(iterations=3000), Physics(iterations=35)):
            world = BulletWorld(PULLED, NaoFarEnd(), physics=physics)
            world.advance(ramp(0.2), ramp(0.15))
            heights.append(since_reset(world.robot_end))
            world.close()
        direct, converged, early = heights
        assert np.abs(direct - converged).max() < 2e-5
        assert np.abs(early - converged).max() > 1e-4

    def test_the_direct_solver_never_falls_back(self, nao, monkeypatch):
        """The engine falls back to iterations in silence; their number would then show."""
        wild = [0.3, 0.3, -0.2, 0.5] * 40, [0.25, -0.02] * 80
        nao.advance(*wild)
        monkeypatch.setitem(DIRECT, "numSolverIterations", 50)
        other = BulletWorld(BODY, NaoFarEnd())
        other.advance(*wild)
        assert other.robot_end == nao.robot_end
        other.close()


@pytest.mark.parametrize(("step", "iterations"), [(0.003, 10), (0.02, 10), (0.0, 10), (0.01, -1)])
def test_impossible_physics_is_refused(step, iterations):
    with pytest.raises(ValueError, match="must"):
        Physics(step=step, iterations=iterations)


@pytest.mark.parametrize(
    "change", [{"mass": 0.0}, {"stiffness": -1.0}, {"visual_delay": 0.6}, {"haptic_delay": -0.1}]
)
def test_impossible_bodies_are_refused(change):
    with pytest.raises(ValueError, match="must"):
        dataclasses.replace(BODY, **change)
