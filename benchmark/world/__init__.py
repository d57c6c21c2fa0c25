"""The physical world: a human and a far end, coupled by a table, in PyBullet."""

from .bullet_world import BulletWorld
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
    "BodyParameters",
    "BulletWorld",
    "FarEnd",
    "Hands",
    "HumanFarEnd",
    "NaoFarEnd",
    "Physics",
    "Servo",
    "World",
    "since_reset",
]
