"""The environment: one lift as a PettingZoo parallel game, an AEC game or a Gymnasium task.

Importing it registers ``colift/Lift-v0`` with Gymnasium, which reads no entry points since 1.0.
"""

from .aec import env
from .parallel import ParallelLift, parallel_env
from .registration import register
from .single import RobotEnv

__all__ = ["ParallelLift", "RobotEnv", "env", "parallel_env"]

register()
