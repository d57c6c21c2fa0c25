"""The environment: one lift as a PettingZoo parallel game, an AEC game or a Gymnasium task."""

from .aec import env
from .lift import Lift
from .parallel import ParallelLift, parallel_env
from .single import RobotEnv

__all__ = ["Lift", "ParallelLift", "RobotEnv", "env", "parallel_env"]
