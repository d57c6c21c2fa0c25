"""The environment: one lift as a PettingZoo parallel game, an AEC game or a Gymnasium task."""

from .parallel import ParallelLift, env, parallel_env
from .single import RobotEnv

__all__ = ["ParallelLift", "RobotEnv", "env", "parallel_env"]
