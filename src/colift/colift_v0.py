"""The environment as PettingZoo's users expect one: ``from colift import colift_v0``."""

from colift.benchmark.environment import env, parallel_env, raw_env

__all__ = ["env", "parallel_env", "raw_env"]
