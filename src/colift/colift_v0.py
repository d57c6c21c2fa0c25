"""The environment as PettingZoo's users expect one: ``from colift import colift_v0``."""

from typing import Any

from pettingzoo import AECEnv
from pettingzoo.utils import parallel_to_aec

from .benchmark.environment import env, parallel_env

__all__ = ["env", "parallel_env", "raw_env"]


def raw_env(**settings: Any) -> AECEnv[str, Any, Any]:
    """Return the AEC environment without a check of the order of calls.

    ``settings`` are those of :func:`.parallel_env`.
    """
    return parallel_to_aec(parallel_env(**settings))
