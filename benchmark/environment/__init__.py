"""The environment: one lift as a PettingZoo parallel game, an AEC game or a Gymnasium task."""

from .aec import env, raw_env
from .parallel import ParallelLift, parallel_env
from .single import RobotEnv
from .state import TrueState
from .wrappers import History, HoldingPace, Scaled, training_env, training_view

__all__ = [
    "History",
    "HoldingPace",
    "ParallelLift",
    "RobotEnv",
    "Scaled",
    "TrueState",
    "env",
    "parallel_env",
    "raw_env",
    "training_env",
    "training_view",
]
