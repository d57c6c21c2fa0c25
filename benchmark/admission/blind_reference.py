"""The trained reference that is blind to the partner, for the tasks that have one."""

import hashlib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Final

from colift.agents.agent import Agent
from colift.agents.spec import InProcess
from colift.agents.tasks.touch.touch_controller import TouchController, read_touch
from colift.agents.tasks.touch.touch_law import TouchNetwork
from colift.base.identity import code_hash

BLIND: Final = "blind_reference"


@dataclass(frozen=True, kw_only=True)
class BlindReference(InProcess):
    """The best trained robot that acts alone, as :class:`.AgentSpec`.

    A network like that of the best known robot, trained on the same lifts for the same error, but
    it sees the partner only to keep level; see :class:`.TouchNetwork` (``colift train apg
    --alone``). In no registry, so that no board can accept it.
    """

    name: str = BLIND
    task: str
    """Name of the task."""

    def check(self) -> None:
        """Do nothing: the weights are shipped."""

    def digest(self) -> str:
        """Return a hash of the weights and of the equations."""
        weights = _weights(self.task).read_bytes()
        return hashlib.sha256(weights + code_hash(TouchController).encode()).hexdigest()[:16]

    def make(self) -> Agent:
        """Return a new robot."""
        return TouchController(_network(self.task))


def has_blind_reference(task: str) -> bool:
    """Return whether one was trained for a task."""
    return _weights(task).is_file()


@cache
def _network(task: str) -> TouchNetwork:
    return read_touch(_weights(task))


def _weights(task: str) -> Traversable:
    return files(__package__).joinpath("data", f"blind_{task}.npz")
