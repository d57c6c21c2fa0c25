"""The physical world: a human and a far end, coupled by a table, in PyBullet."""

from .ball import Ball
from .bullet_world import BulletWorld
from .haptic_world import HapticWorld
from .human_body import BodyParameters
from .nao_arms import NaoFarEnd
from .physics import PHYSICS, Physics
from .second_human import HumanFarEnd
from .servo import SERVO, Servo
from .world import HISTORY_FRAMES, FarEnd, Hands, World, since_reset

__all__ = [
    "HISTORY_FRAMES",
    "PHYSICS",
    "SERVO",
    "Ball",
    "BodyParameters",
    "BulletWorld",
    "FarEnd",
    "Hands",
    "HapticWorld",
    "HumanFarEnd",
    "NaoFarEnd",
    "Physics",
    "Servo",
    "World",
    "since_reset",
]
