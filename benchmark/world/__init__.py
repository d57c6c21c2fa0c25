"""The physical world: a human and a far end, coupled by a table, in PyBullet."""

from colift.benchmark.world.ball import Ball
from colift.benchmark.world.bullet_world import BulletWorld
from colift.benchmark.world.human_body import BodyParameters
from colift.benchmark.world.interface import (
    HISTORY_FRAMES,
    Engine,
    FarEnd,
    Hands,
    Intended,
    World,
    since_reset,
)
from colift.benchmark.world.nao_arms import NaoFarEnd
from colift.benchmark.world.physics import PHYSICS, Physics
from colift.benchmark.world.second_human import HumanFarEnd
from colift.benchmark.world.servo import SERVO, Servo

__all__ = [
    "HISTORY_FRAMES",
    "PHYSICS",
    "SERVO",
    "Ball",
    "BodyParameters",
    "BulletWorld",
    "Engine",
    "FarEnd",
    "Hands",
    "HumanFarEnd",
    "Intended",
    "NaoFarEnd",
    "Physics",
    "Servo",
    "World",
    "since_reset",
]
