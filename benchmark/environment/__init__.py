"""The environment: one lift as a PettingZoo parallel game, an AEC game or a Gymnasium task."""

from .parallel import ParallelLift, env, parallel_env
from .single import RobotEnv
from .wrappers import History, HoldingPace, Scaled, training_env, training_view

__all__ = [
    "History",
    "HoldingPace",
    "ParallelLift",
    "RobotEnv",
    "Scaled",
    "env",
    "parallel_env",
    "training_env",
    "training_view",
]
