"""The turn-by-turn (AEC) view of the parallel environment."""

from typing import Any

from pettingzoo import AECEnv
from pettingzoo.utils import OrderEnforcingWrapper, parallel_to_aec

from .parallel import parallel_env


def env(**settings: Any) -> AECEnv[str, Any, Any]:
    """Return the AEC environment; ``settings`` are those of :func:`.parallel_env`."""
    return OrderEnforcingWrapper(parallel_to_aec(parallel_env(**settings)))
