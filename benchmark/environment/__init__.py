"""The environment: one lift as a PettingZoo parallel game, an AEC game or a Gymnasium task."""

from colift.benchmark.environment.aec import env, raw_env
from colift.benchmark.environment.moment import Moment
from colift.benchmark.environment.parallel import ParallelLift, parallel_env
from colift.benchmark.environment.single import RobotEnv
from colift.benchmark.environment.state import TrueState
from colift.benchmark.environment.wrappers import (
    History,
    HoldingPace,
    Scaled,
    training_env,
    training_view,
)

__all__ = [
    "History",
    "HoldingPace",
    "Moment",
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
