"""The physical world: NAO or human, table and human, coupled both ways, in PyBullet."""

from .human_body import BodyParameters
from .physics import PHYSICS, Physics
from .servo import SERVO, Servo
from .world import Partner, World

__all__ = ["PHYSICS", "SERVO", "BodyParameters", "Partner", "Physics", "Servo", "World"]
