"""The rolling ball: period, energy and work."""

import math
from contextlib import closing

import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.humans import SUBJECTS
from colift.benchmark.episode.seat import body_parameters
from colift.benchmark.world.ball import ROLLING, Ball, TableMotion
from colift.benchmark.world.bullet_world import BulletWorld
from colift.benchmark.world.interface import since_reset
from colift.benchmark.world.nao_end import NaoFarEnd
from colift.benchmark.world.table import GRAVITY, TABLE_LENGTH

STILL = TableMotion(pitch=0.0, pitch_rate=0.0, turn=0.0, rise=0.0, push=0.0)
HALF = TABLE_LENGTH / 2


def roll(ball, place, speed, tables, step=FRAME):
    """Return places and speeds after each step, the first ones included."""
    places, speeds = [place], [speed]
    for table in tables:
        place, speed = ball.rolled(place, speed, table, step)
        places.append(place)
        speeds.append(speed)
    return np.array(places), np.array(speeds)


@pytest.mark.parametrize("radius", [0.5, 2.0])
def test_the_period_in_a_bowl_is_that_of_a_rolling_pendulum(radius):
    """T = 2 pi sqrt(7 R / (5 g)) for small swings."""
    ball = Ball(friction=0.0, curvature=1 / radius)
    places, _ = roll(ball, 0.02, 0.0, [STILL] * 3000)
    down = np.flatnonzero((places[:-1] > 0) & (places[1:] <= 0))
    crossings = down + places[down] / (places[down] - places[down + 1])
    period = FRAME * np.diff(crossings).mean()
    assert period == pytest.approx(2 * math.pi * math.sqrt(radius / (ROLLING * GRAVITY)), rel=0.002)


def test_a_ball_in_a_bowl_conserves_energy():
    ball, radius = Ball(friction=0.0, curvature=2.0), 0.5
    places, speeds = roll(ball, 0.1, 0.0, [STILL] * 1000)
    height = radius * (1 - np.cos(places / radius))
    energy = 0.7 * speeds**2 + GRAVITY * height
    assert np.abs(energy / energy[0] - 1).max() < 0.002


def test_a_ball_on_an_inclined_table_has_five_sevenths_of_the_downhill_acceleration():
    table = STILL._replace(pitch=0.05)
    places, speeds = roll(Ball(friction=0.0), 0.1, 0.0, [table] * 100)
    assert speeds[-1] == pytest.approx(-5 / 7 * GRAVITY * math.sin(0.05), rel=1e-9)
    assert places[-1] == pytest.approx(0.1 + speeds[-1] / 2, rel=1e-9)


def test_friction_slows_the_ball_down_exponentially():
    _, speeds = roll(Ball(friction=0.5), 0.0, 0.2, [STILL] * 200)
    assert speeds[-1] == pytest.approx(0.2 * math.exp(-1.0), rel=1e-4)


def prescribed(count):
    """Return hinge heights and pitches of a made-up lift, at the ends of the steps."""
    t = np.linspace(0.0, 1.0, count + 1)
    rise = 0.2 * t**3 * (10 - 15 * t + 6 * t**2)
    return rise, 0.06 * np.sin(2 * np.pi * t) * np.sin(np.pi * t) ** 2


def balance(ball, hinge, pitch, places, speeds, step):
    """Return the ball's energy at each step, and the work done on it until then [J].

    The work is that of the normal force and of the static friction at the material point of the
    table in contact, which follow from the acceleration of the centre across and along the table.
    """
    rise, rate = np.diff(hinge) / step, np.diff(pitch) / step
    lift, turning = np.gradient(rise, step), np.gradient(rate, step)
    middle, p = (places[1:] + places[:-1]) / 2, (pitch[1:] + pitch[:-1]) / 2
    w = (speeds[1:] + speeds[:-1]) / 2
    r = HALF + middle
    outward = r * turning + (2 * (w + ball.radius * rate) - ball.radius * rate) * rate
    normal = ball.mass * ((GRAVITY + lift) * np.cos(p) + outward)
    along = np.diff(speeds) / step - r * rate**2 + lift * np.sin(p)
    friction = ball.mass * (along + GRAVITY * np.sin(p))
    power = normal * (rise * np.cos(p) + r * rate) + friction * rise * np.sin(p)
    # Kinetic energy with the spin (2/5 m w^2), at the middles of the steps.
    across = r * rate + rise * np.cos(p)
    kinetic = ball.mass / 2 * (1.4 * w**2 + 2 * w * rise * np.sin(p) + across**2)
    kinetic += ball.mass / 2 * (rise * np.sin(p)) ** 2
    height = (hinge[1:] + hinge[:-1]) / 2 + r * np.sin(p) + ball.radius * np.cos(p)
    energy = kinetic + ball.mass * GRAVITY * height
    return energy, np.cumsum(power) * step


def test_the_energy_of_a_ball_on_a_moving_table_is_the_work_of_the_table():
    ball, count = Ball(friction=0.0), 200
    hinge, pitch = prescribed(count)
    step = FRAME
    rise = np.diff(hinge) / step
    lift = np.gradient(rise, step)
    tables = [
        TableMotion(
            pitch=(pitch[i] + pitch[i + 1]) / 2,
            pitch_rate=(pitch[i + 1] - pitch[i]) / step,
            turn=pitch[i + 1] - pitch[i],
            rise=lift[i],
            push=0.0,
        )
        for i in range(count)
    ]
    places, speeds = roll(ball, 0.05, 0.0, tables)
    energy, work = balance(ball, hinge, pitch, places, speeds, step)
    gained, done = energy - energy[0], work - work[0]
    assert np.ptp(speeds) > 0.1
    assert np.abs(gained - done).max() < 0.01 * np.ptp(energy)


def test_so_it_is_in_a_lift_of_the_engine():
    """The table moves as the engine has it; its slide to and fro, of millimetres, is left out."""
    ball = Ball(friction=0.0)
    with closing(BulletWorld(body_parameters(SUBJECTS["S3"]), NaoFarEnd(), ball=ball)) as world:
        near = 0.1 * prescribed(150)[0][1:] / 0.2
        far = near + 0.03 * np.sin(np.linspace(0.0, 2 * np.pi, 150))
        for start in range(0, 150, 10):
            world.advance(near[start : start + 10].tolist(), far[start : start + 10].tolist())
        ends = since_reset(world.human_end), since_reset(world.robot_end)
        places, speeds = since_reset(world.ball_place), since_reset(world.ball_speed)
    pitch = np.arcsin((ends[1] - ends[0]) / TABLE_LENGTH)
    energy, work = balance(ball, ends[0], pitch, places, speeds, FRAME)
    assert np.ptp(speeds) > 0.05
    assert np.abs(energy - energy[0] - work + work[0]).max() < 0.01 * np.ptp(energy)
